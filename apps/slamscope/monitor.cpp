// SPDX-License-Identifier: MIT
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <stdexcept>
#include <thread>

#include "apps/lib/progress.hpp"
#include "apps/lib/view/monitor.hpp"
#include "apps/lib/view/viewer_window.hpp"
#include "apps/slamscope/monitor_flags.hpp"
#include "apps/slamscope/verbs.hpp"

namespace slamscope::apps {
namespace {

std::atomic<bool> g_interrupted = false;  // NOLINT: what a signal handler can reach

/// Ctrl-C ends the film as its own end would, so that outputs are whole.
void endOnInterrupt() {
  std::signal(SIGINT, [](int) { g_interrupted = true; });
  std::signal(SIGTERM, [](int) { g_interrupted = true; });
}

void runHeadless(Monitor& monitor) {
  Progress progress("drawing");
  const auto start = std::chrono::steady_clock::now();
  while (!g_interrupted && monitor.next()) {
    if (monitor.paced()) {
      std::this_thread::sleep_until(start +
                                    std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::duration<double>(monitor.secondsShown())));
    }
    monitor.draw();
    const std::string frames = std::to_string(monitor.framesShown()) + " frames";
    if (monitor.progress() >= 0.0) {
      progress.show(monitor.progress(), frames);
    } else {
      progress.show(frames + "  " + monitor.status());
    }
  }
}

void reportValidation(const Monitor& monitor) {
  const auto messages = monitor.gpu()->validationMessages();
  if (!messages.empty()) {
    throw std::runtime_error(
        std::to_string(messages.size()) +
        " messages of Vulkan's validation layer, the first: " + messages.front());
  }
}

}  // namespace

void runMonitor(const MonitorOptions& options) {
  endOnInterrupt();
  Monitor monitor(options);
  for (const std::string& note : monitor.notes()) spdlog::info("{}", note);
  if (options.window) {
    runInWindow(monitor, "slamscope – " + options.camera);
  } else {
    runHeadless(monitor);
  }
  spdlog::info("{} frames, {}", monitor.framesShown(), monitor.status());
  monitor.finish();
  for (const auto& file : {options.output, options.picture, options.compare, options.report}) {
    if (!file.empty()) spdlog::info("wrote {}", file.string());
  }
  reportValidation(monitor);
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
