// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "tracking/head_history.hpp"
#include "tracking/rig.hpp"

namespace slamscope::tracking {

/// What is wrong with the times of pictures. A complaint lasts for two seconds of theirs.
class PictureOrder {
 public:
  explicit PictureOrder(const Rig& rig) : two_(rig.cameras.size() > 1) {}

  /// Whether a picture (time offset added) still counts: not one that came before, nor one older
  /// than the history.
  bool accepts(const HeadPicture& picture, const HeadHistory& history);
  /// Looks at the eyes of one pair: exposed further apart than half the time between frames?
  void compare(const std::vector<HeadPicture>& pair);
  [[nodiscard]] std::vector<std::string> problems() const;

 private:
  void complain(const std::string& what);

  bool two_;
  std::array<std::chrono::nanoseconds, 2> last_{std::chrono::nanoseconds::min(),
                                                std::chrono::nanoseconds::min()};
  std::chrono::nanoseconds interval_{0};  // of frames
  std::chrono::nanoseconds newest_{std::chrono::nanoseconds::min()};
  std::map<std::string, std::chrono::nanoseconds> complaints_;  // and when they were last made
};

}  // namespace slamscope::tracking
