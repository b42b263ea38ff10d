// SPDX-License-Identifier: MIT
#include "slam/audit/law_words.hpp"

#include <array>

namespace slamscope::slam {

std::string_view lawWords(Law law) {
  static constexpr std::array<std::string_view, kLawCount> kWords{
      "every number of x and P is finite",
      "P equals its transpose",
      "no variance, in any direction, is negative",
      "an observation makes no variance and no P_d grow",
      "an update changes P only in the directions that the observed features give",
      "an update changes P in at most two directions for each observed feature",
      "x and P are updated with the same gain",
      "a prediction leaves the features and their covariance alone",
      "a prediction carries the covariance of robot and map along with the robot's motion",
      "the noise that a prediction adds is a covariance, and the declared one",
      "a new feature's covariance is that of the robot's pose carried over, plus the sensor's "
      "noise",
      "innovations are as large as the filter believes (chi squared, from x and P alone)",
      "the sensor noise that the updates imply is the declared one, and steady",
      "the heading never gets better known than it was at the start",
      "innovations are not correlated over time",
      "the innovations in the log are as large as the S beside them says",
      "the H in the log is the derivative of the sensor's equation",
      "the error against the truth is as large as P says"};
  return kWords.at(static_cast<std::size_t>(law));
}

}  // namespace slamscope::slam
