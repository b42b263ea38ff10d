// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/slamscope/monitor_flags.hpp"
#include "apps/slamscope/verbs.hpp"
#include "engine/window/display.hpp"

namespace slamscope::apps {

void addDemo(CLI::App& program) {
  const auto flags = std::make_shared<MonitorFlags>();
  flags->rest.slam_rate = 2.0;
  flags->simulation.rest.loops = 2;
  CLI::App* verb = program.add_subcommand(
      "demo", "everything with nothing plugged in: simulated robot, synthetic lab, live window");
  verb->footer(
      "Example: slamscope demo --fault paper\n"
      "Without a display it writes out/demo.mp4 and out/demo.png.");
  addMonitorFlags(*verb, *flags);
  verb->callback([flags] {
    MonitorOptions options = flags->options();
    if (!options.output.empty() || !options.picture.empty()) return runMonitor(options);
    if (engine::displayAvailable()) {
      options.window = true;
      return runMonitor(options);
    }
    spdlog::info("no display here: writing a video and a picture instead of opening a window");
    std::filesystem::create_directories("out");
    options.output = "out/demo.mp4";
    options.picture = "out/demo.png";
    runMonitor(options);
  });
}

}  // namespace slamscope::apps
