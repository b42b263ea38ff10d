// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace slamscope::engine {

/// Keys that type no character; all others come as Key::character.
enum class Key {
  character,
  escape,
  enter,
  tab,
  backspace,
  remove,
  left,
  right,
  up,
  down,
  page_up,
  page_down,
  home,
  end,
  f1,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f9,
  f10,
  f11,
  f12,
};

/// One press, held keys repeat. A character is what the person's keyboard layout types ('M' with
/// shift is 'M', the space bar is ' '), so keys are where they are written on the keyboard.
struct KeyPress {
  Key key = Key::character;
  char32_t character = 0;  ///< only of Key::character
  bool shift = false;      ///< of the other keys
  bool control = false;
  bool alt = false;
};

/// One press of a mouse button inside the picture.
struct Click {
  Eigen::Vector2d picture_px = Eigen::Vector2d::Zero();  ///< OpenCV's convention, of that view
  int view = 0;                                          ///< 0, or 1 in the right half of a pair
  int button = 0;                                        ///< 0 left, 1 right, 2 middle
  bool shift = false;
};

/// What a person did since the last Window::poll(), in order.
struct Input {
  std::vector<KeyPress> keys;
  std::vector<Click> clicks;
};

}  // namespace slamscope::engine
