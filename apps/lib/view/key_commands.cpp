// SPDX-License-Identifier: MIT
#include "apps/lib/view/key_commands.hpp"

#include <utility>

#include "apps/lib/view/scene_builder.hpp"

namespace slamscope::apps {

void KeyCommands::nextMode() {
  using slam::PairMode;
  switch (choices_.mode) {
    case PairMode::all:
      choices_.mode = PairMode::between_clusters;
      break;
    case PairMode::between_clusters:
      choices_.mode = PairMode::min_mean_max;
      break;
    case PairMode::min_mean_max:
      choices_.mode = PairMode::alarms;
      break;
    default:
      choices_.mode = PairMode::all;
      break;
  }
}

void KeyCommands::nextAxis() {
  using slam::Axis;
  switch (choices_.axis.axis) {
    case Axis::sigma:
      choices_.axis.axis = Axis::eigenvalue;
      break;
    case Axis::eigenvalue:
      choices_.axis.axis = Axis::log;
      break;
    case Axis::log:
      choices_.axis.axis = Axis::sigma;
      break;
  }
  choices_.axis.gain = defaultGain(choices_.axis.axis);
}

void KeyCommands::nextFade() {
  choices_.opacity = choices_.opacity > 0.6 ? 0.4 : choices_.opacity > 0.2 ? 0.0 : 1.0;
}

void KeyCommands::press(char32_t key) {
  choices_.message.clear();
  switch (key) {
    case 'm':
      return nextMode();
    case 'a':
      return nextAxis();
    case '+':
    case '=':
      choices_.axis.gain *= 1.25;
      return;
    case '-':
      choices_.axis.gain /= 1.25;
      return;
    case 'e':
      choices_.covariance_rings = !choices_.covariance_rings;
      return;
    case 'o':
      choices_.own_error = !choices_.own_error;
      return;
    case 'l':
      choices_.labels = !choices_.labels;
      return;
    case 'g':
      choices_.legend = !choices_.legend;
      return;
    case 'c':
      choices_.palette =
          choices_.palette == PaletteName::paper ? PaletteName::safe : PaletteName::paper;
      return;
    case 'f':
      return nextFade();
    case ' ':
      paused_ = !paused_;
      return say(paused_ ? "paused · space goes on, . shows one frame" : "");
    case '.':
      paused_ = step_ = true;
      return;
    case 's':
      screenshot_ = true;
      return;
    case 'h':
    case '?':
      return say(kHelp);
    case 'q':
      quit_ = true;
      return;
    default:
      return;
  }
}

bool KeyCommands::takeStep() {
  return std::exchange(step_, false);
}
bool KeyCommands::takeScreenshot() {
  return std::exchange(screenshot_, false);
}

}  // namespace slamscope::apps
