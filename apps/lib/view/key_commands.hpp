// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/lib/view/viewer.hpp"

namespace slamscope::apps {

/// What the keys of a viewer do. Knows nothing of windows.
class KeyCommands {
 public:
  explicit KeyCommands(Viewer::Choices& choices) : choices_(choices) {}

  /// One character as typed. Unknown keys do nothing.
  void press(char32_t key);

  [[nodiscard]] bool paused() const { return paused_; }
  [[nodiscard]] bool quit() const { return quit_; }
  /// True once for each press of the key for one frame.
  [[nodiscard]] bool takeStep();
  /// True once for each press of the key for a screenshot.
  [[nodiscard]] bool takeScreenshot();
  void say(std::string message) { choices_.message = std::move(message); }

  static constexpr const char* kHelp =
      "m mode   a axis   + - gain   e rings   o own error   l labels   g legend   c colours   "
      "f fade   space pause   . step   s screenshot   h keys   q quit";

 private:
  void nextMode();
  void nextAxis();
  void nextFade();

  Viewer::Choices& choices_;
  bool paused_ = false;
  bool quit_ = false;
  bool step_ = false;
  bool screenshot_ = false;
};

}  // namespace slamscope::apps
