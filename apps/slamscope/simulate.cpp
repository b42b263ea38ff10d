// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include "apps/lib/monte_carlo_report.hpp"
#include "apps/lib/progress.hpp"
#include "apps/slamscope/flags.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/recorder.hpp"
#include "slam/simulation.hpp"

namespace slamscope::apps {
namespace {

struct SimulateFlags {
  SimulationFlags simulation;
  std::string record = "steps";
  std::string output = "run.jsonl";
  int runs = 0;
  double confidence = 0.95;
  std::string json;
  bool list_faults = false;
};

void writeRun(const SimulateFlags& flags) {
  slam::Simulation simulation(flags.simulation.options());
  slam::Recorder recorder(simulation.filter(), flags.output, simulation.header(),
                          flags.record == "all" ? slam::kRecordAll : slam::kRecordSteps);
  Progress progress("simulating");
  while (simulation.step()) progress.show(simulation.progress());
  recorder.finish();
  spdlog::info("{}: {} records, {} features", flags.output, recorder.records(),
               simulation.filter().state().featureCount());
}

void runMany(const SimulateFlags& flags) {
  slam::MonteCarloOptions options{.simulation = flags.simulation.options(),
                                  .runs = flags.runs,
                                  .confidence = flags.confidence,
                                  .progress = {}};
  const std::filesystem::path partial = flags.json + ".partial";
  std::ofstream out;
  if (!flags.json.empty()) {
    out.open(partial);  // before the work, not after it
    if (!out) throw std::runtime_error(flags.json + ": can't be written");
  }
  slam::MonteCarloResult result;
  {
    Progress progress("simulating");
    options.progress = [&](int done) {
      progress.show(static_cast<double>(done) / flags.runs,
                    std::to_string(done) + " of " + std::to_string(flags.runs) + " runs");
    };
    result = slam::runMonteCarlo(options);
  }
  std::fputs(monteCarloText(result, options.simulation).c_str(), stdout);
  if (flags.json.empty()) return;
  out << monteCarloJson(result, options.simulation);
  out.close();
  if (!out) throw std::runtime_error(flags.json + ": can't be written");
  std::filesystem::rename(partial, flags.json);
  spdlog::info("wrote {}", flags.json);
}

/// Words that belong to one of the two uses only are refused in the other.
void refuseMixture(const CLI::App& verb, const SimulateFlags& flags) {
  if (flags.runs > 0) {
    for (const char* word : {"--output", "--record"}) {
      if (verb.count(word) == 0) continue;
      throw std::invalid_argument(std::string(word) +
                                  ": --runs writes no run; to have one of them, give its --seed "
                                  "and leave --runs out");
    }
    return;
  }
  for (const char* word : {"--json", "--confidence"}) {
    if (verb.count(word) == 0) continue;
    throw std::invalid_argument(std::string(word) + " needs --runs N");
  }
}

}  // namespace

void addSimulate(CLI::App& program) {
  const auto flags = std::make_shared<SimulateFlags>();
  CLI::App* verb = program.add_subcommand(
      "simulate", "the paper's simulated experiment, written as a run with its truth");
  verb->footer(
      "Examples:\n"
      "  slamscope simulate --fault paper --loops 2 -o faulty.jsonl.zst\n"
      "  slamscope simulate --runs 200 --json consistency.json     is the filter consistent?");
  addSimulationFlags(*verb, flags->simulation);
  verb->add_option("--record", flags->record,
                   "steps: one record per time; all: every prediction, update and initialisation")
      ->check(CLI::IsMember({"steps", "all"}));
  verb->add_option("-o,--output", flags->output,
                   "run to write (.jsonl, .jsonl.zst; - is standard output)");
  verb->add_flag("--list-faults", flags->list_faults, "print the faults and stop");
  const std::string group = "Monte Carlo";
  verb->add_option("--runs", flags->runs,
                   "so many runs, seeds from --seed on, on all cores: their ANEES and NIS with "
                   "two-sided bands, and no run is written")
      ->check(CLI::Range(1, 1000000))
      ->group(group);
  verb->add_option("--confidence", flags->confidence, "of the bands")
      ->check(CLI::Range(0.01, 0.999999))
      ->group(group);
  verb->add_option("--json", flags->json, "the same as JSON, with every time step")->group(group);
  verb->callback([flags, verb] {
    if (flags->list_faults) return listFaults();
    refuseMixture(*verb, *flags);
    if (flags->runs > 0) return runMany(*flags);
    writeRun(*flags);
  });
}

}  // namespace slamscope::apps
