// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <memory>

#include "apps/lib/view/monitor.hpp"
#include "apps/slamscope/monitor_flags.hpp"
#include "apps/slamscope/run_viewer.hpp"
#include "apps/slamscope/verbs.hpp"

namespace slamscope::apps {

void runMonitor(const MonitorOptions& options) {
  Monitor monitor(options);
  runViewer(monitor, {.window = options.window,
                      .title = "slamscope – " + options.camera,
                      .screen = {},
                      .files = {options.output, options.picture, options.compare, options.report}});
}

void addMonitor(CLI::App& program) {
  const auto flags = std::make_shared<MonitorFlags>();
  CLI::App* verb = program.add_subcommand(
      "monitor", "the overhead view: what a filter believes, drawn over a camera's picture");
  verb->footer(
      "Examples:\n"
      "  slamscope monitor                                       a window: lab and simulated "
      "robot\n"
      "  slamscope monitor --slam run.jsonl --output out.mp4     a recorded run in the lab\n"
      "  your_filter | slamscope monitor --slam -                a filter in any language, live\n"
      "  slamscope monitor --camera /dev/video0 --camera-info K.yaml --tags floor.yaml \\\n"
      "                    --slam tcp://127.0.0.1:7007           a real camera, a live filter");
  addMonitorFlags(*verb, *flags);
  verb->callback([flags] {
    MonitorOptions options = flags->options();
    const bool to_files = !options.output.empty() || !options.picture.empty() ||
                          !options.compare.empty() || !options.report.empty();
    options.window = options.window || !to_files;
    runMonitor(options);
  });
}

}  // namespace slamscope::apps
