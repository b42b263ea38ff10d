// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "apps/lib/progress.hpp"
#include "apps/slamscope/verbs.hpp"
#include "slam/run_reader.hpp"
#include "slam/run_writer.hpp"

namespace slamscope::apps {

void addConvert(CLI::App& program) {
  struct Options {
    std::string from, to;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* verb =
      program.add_subcommand("convert", "write a run in another format, by its ending");
  verb->footer(
      "Examples:\n"
      "  slamscope convert run.jsonl run.jsonl.zst\n"
      "  slamscope convert run.mat run.jsonl");
  verb->add_option("A", options->from,
                   "run to read (.jsonl, .jsonl.zst, .npz, .npy, .mat, MRPT's directory)")
      ->required();
  verb->add_option("B", options->to, "run to write (.jsonl, .jsonl.zst)")->required();
  verb->callback([options] {
    slam::RunReader reader(options->from);
    slam::RunWriter writer(options->to, reader.header());
    Progress progress("converting");
    while (const auto snapshot = reader.next()) {
      writer.write(**snapshot);
      progress.show(std::to_string(writer.records()) + " records");
    }
    writer.finish();
    for (const std::string& warning : reader.warnings()) spdlog::warn("{}", warning);
    spdlog::info("{}: {} records", options->to, writer.records());
  });
}

}  // namespace slamscope::apps
