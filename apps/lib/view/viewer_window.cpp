// SPDX-License-Identifier: MIT
#include "apps/lib/view/viewer_window.hpp"

#include <chrono>
#include <ctime>
#include <thread>

#include "apps/lib/view/key_commands.hpp"
#include "apps/lib/view/picture_output.hpp"
#include "engine/window/window.hpp"

namespace slamscope::apps {
namespace {

using Clock = std::chrono::steady_clock;

/// Holds frames that come from a file or a lab to the pace at which they were taken.
class Pace {
 public:
  /// Whether the frame after the one `shown` seconds into the film is due.
  [[nodiscard]] bool due(double shown, double frame_seconds) const {
    return std::chrono::duration<double>(Clock::now() - start_).count() >= shown + frame_seconds;
  }
  /// Time stands still while paused or late: start again from here.
  void rebase(double shown) {
    start_ = Clock::now() -
             std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(shown));
  }

 private:
  Clock::time_point start_ = Clock::now();
};

std::string screenshotName() {
  const std::time_t now = std::time(nullptr);
  char name[64];
  std::strftime(name, sizeof name, "slamscope-%Y%m%d-%H%M%S.png", std::localtime(&now));
  return name;
}

void handle(const engine::Input& input, KeyCommands& keys) {
  for (const engine::KeyPress& press : input.keys) {
    if (press.key == engine::Key::character) keys.press(press.character);
    if (press.key == engine::Key::escape) keys.press('q');
  }
}

}  // namespace

Viewer::Ending runInWindow(Viewer& viewer, const std::string& title, std::optional<int> screen,
                           const std::atomic<bool>& interrupted) {
  if (!viewer.next()) return Viewer::Ending::input_ended;
  viewer.draw();
  engine::Window window(viewer.gpu(), {.title = title,
                                       .width = viewer.drawn().width,
                                       .height = viewer.drawn().height,
                                       .monitor = screen.value_or(0),
                                       .full_screen = screen.has_value()});
  KeyCommands keys(viewer.choices());
  keys.say(KeyCommands::kHelp);
  Pace pace;
  bool ended = false;
  while (window.open() && !keys.quit() && !interrupted) {
    const engine::Input input = window.poll();
    handle(input, keys);
    for (const engine::Click& click : input.clicks) viewer.explain(click.picture_px);
    const double shown = viewer.secondsShown();
    const bool step = keys.takeStep();
    const bool due = !viewer.paced() || pace.due(shown, viewer.frameSeconds());
    if (!ended && (step || (!keys.paused() && due))) {
      ended = !viewer.next();
      if (ended) keys.say("the end of the input · q closes the window");
    }
    if (keys.paused() || ended) {
      pace.rebase(shown);
      std::this_thread::sleep_for(std::chrono::milliseconds(15));
    } else if (!due) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    // Late by more than a quarter of a second: go on from here instead of racing after it.
    if (pace.due(viewer.secondsShown(), 0.25)) pace.rebase(viewer.secondsShown());
    viewer.draw();
    window.show({&viewer.drawn(), 1});
    viewer.presented();
    if (keys.takeScreenshot()) {
      const std::string name = screenshotName();
      writePicture(name, viewer.drawn());
      keys.say("wrote " + name);
    }
  }
  return ended ? Viewer::Ending::input_ended : Viewer::Ending::user_quit;
}

}  // namespace slamscope::apps
