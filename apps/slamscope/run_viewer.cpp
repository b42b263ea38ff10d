// SPDX-License-Identifier: MIT
#include "apps/slamscope/run_viewer.hpp"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "apps/lib/freed_memory.hpp"
#include "apps/lib/progress.hpp"
#include "apps/lib/view/viewer_window.hpp"

namespace slamscope::apps {
namespace {

std::atomic<bool> g_interrupted = false;  // NOLINT: what a signal handler can reach

/// Ctrl-C ends the film as its own end would, so that outputs are whole; a second one ends at once.
void endOnInterrupt() {
  const auto end = [](int signal) {
    g_interrupted = true;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, end);
  std::signal(SIGTERM, end);
}

Viewer::Ending runHeadless(Viewer& viewer) {
  Progress progress("drawing");
  const auto start = std::chrono::steady_clock::now();
  while (viewer.next()) {
    if (viewer.paced()) {
      std::this_thread::sleep_until(start +
                                    std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::duration<double>(viewer.secondsShown())));
    }
    viewer.draw();
    viewer.presented();
    const std::string frames = std::to_string(viewer.framesShown()) + " frames";
    if (viewer.progress() >= 0.0) {
      progress.show(viewer.progress(), frames);
    } else {
      progress.show(frames + "  " + viewer.status());
    }
    if (g_interrupted) return Viewer::Ending::user_quit;
  }
  return Viewer::Ending::input_ended;
}

void reportValidation(const Viewer& viewer) {
  const auto messages = viewer.gpu()->validationMessages();
  if (!messages.empty()) {
    throw std::runtime_error(
        std::to_string(messages.size()) +
        " messages of Vulkan's validation layer, the first: " + messages.front());
  }
}

}  // namespace

void runViewer(Viewer& viewer, const ViewerRun& run) {
  shareOneArena();
  endOnInterrupt();
  for (const std::string& note : viewer.notes()) spdlog::info("{}", note);
  const Viewer::Ending ending =
      run.window ? runInWindow(viewer, run.title, run.screen, g_interrupted) : runHeadless(viewer);
  spdlog::info("{} frames, {}", viewer.framesShown(), viewer.status());
  viewer.finish(ending);
  for (const auto& file : run.files) {
    if (!file.empty()) spdlog::info("wrote {}", file.string());
  }
  reportValidation(viewer);
}

}  // namespace slamscope::apps
