// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

#include "apps/lib/progress.hpp"
#include "apps/slamscope/flags.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/recorder.hpp"
#include "slam/simulation.hpp"

namespace slamscope::apps {

void addSimulate(CLI::App& program) {
  struct Options {
    SimulationFlags flags;
    std::string record = "steps";
    std::string output = "run.jsonl";
    bool list_faults = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* verb = program.add_subcommand(
      "simulate", "the paper's simulated experiment, written as a run with its truth");
  verb->footer("Example: slamscope simulate --fault paper --loops 2 -o faulty.jsonl.zst");
  addSimulationFlags(*verb, options->flags);
  verb->add_option("--record", options->record,
                   "steps: one record per time; all: every prediction, update and initialisation")
      ->check(CLI::IsMember({"steps", "all"}));
  verb->add_option("-o,--output", options->output,
                   "run to write (.jsonl, .jsonl.zst; - is standard output)");
  verb->add_flag("--list-faults", options->list_faults, "print the faults and stop");
  verb->callback([options] {
    if (options->list_faults) return listFaults();
    slam::Simulation simulation(options->flags.options());
    slam::Recorder recorder(simulation.filter(), options->output, simulation.header(),
                            options->record == "all" ? slam::kRecordAll : slam::kRecordSteps);
    Progress progress("simulating");
    while (simulation.step()) progress.show(simulation.progress());
    recorder.finish();
    spdlog::info("{}: {} records, {} features", options->output, recorder.records(),
                 simulation.filter().state().featureCount());
  });
}

}  // namespace slamscope::apps
