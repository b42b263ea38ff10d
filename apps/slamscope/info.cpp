// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "apps/lib/json_reports.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/jsonl.hpp"
#include "slam/run_reader.hpp"
#include "slam/run_summary.hpp"

namespace slamscope::apps {
namespace {

std::string_view eventOf(std::size_t index) {
  return slam::eventName(static_cast<slam::Event>(index));
}

using slam::seconds;

void print(const slam::RunSummary& run) {
  std::printf("records   %llu, %llu steps of time\n", static_cast<unsigned long long>(run.records),
              static_cast<unsigned long long>(run.steps));
  std::printf("events   ");
  for (std::size_t k = 0; k < run.events.size(); ++k) {
    if (run.events[k] > 0) {
      std::printf(" %llu %s", static_cast<unsigned long long>(run.events[k]), eventOf(k).data());
    }
  }
  std::printf("\nfeatures  %d at the end, %d at most, %llu different\n", run.features_at_end,
              run.features_at_most, static_cast<unsigned long long>(run.different_features));
  std::printf("duration  %.3f s from t = %.3f s\n", seconds(run.duration()), seconds(run.first));
  std::printf("level     %s\n", run.levelName().c_str());
  std::printf("sensor    %s\n", slam::sensorName(run.header.sensor).data());
  if (!run.header.robot.empty()) std::printf("robot     %s\n", run.header.robot.c_str());
  if (run.first_not_finite) {
    std::printf("broken    record %llu is the first with a number that is not finite\n",
                static_cast<unsigned long long>(*run.first_not_finite));
  }
}

}  // namespace

void addInfo(CLI::App& program) {
  struct Options {
    std::string run;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("info", "what is in a run: steps, features, duration, level");
  verb->footer(
      "Examples:\n"
      "  slamscope info run.jsonl.zst\n"
      "  slamscope info run.mat --json\n"
      "\n"
      "Runs: .jsonl, .jsonl.zst; .npz, .npy (NumPy); .mat (MATLAB, Octave); a directory of MRPT's "
      "kf-slam.");
  verb->add_option("RUN", options->run,
                   "run to read (.jsonl, .jsonl.zst, .npz, .npy, .mat, MRPT's directory)")
      ->required();
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options] {
    slam::RunReader reader(options->run);
    const slam::RunSummary summary = slam::summarize(reader);
    for (const std::string& warning : summary.warnings) spdlog::warn("{}", warning);
    if (options->json) {
      std::fputs(summaryJson(summary).c_str(), stdout);
    } else {
      print(summary);
    }
  });
}

}  // namespace slamscope::apps
