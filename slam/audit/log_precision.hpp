// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

namespace slamscope::slam {

/// How coarsely the numbers of a log were rounded, found from the numbers themselves. Only ever
/// gets finer: every number that needs more digits than thought so far corrects it; a log of
/// doubles gives itself away at once. What rounds a number v changes it by at most relative() |v| +
/// absolute().
class LogPrecision {
 public:
  /// Looks at up to ~100 of the numbers. Zeros and non-finite ones say nothing.
  void take(std::span<const double> numbers);

  [[nodiscard]] double relative() const;
  [[nodiscard]] double absolute() const;
  /// "double", "float32", "6 digits", "6 decimals", "unknown" where no number was seen.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] bool isDouble() const { return digits_ >= kDouble && !float32_; }
  /// Less than doubles.
  [[nodiscard]] bool isRounded() const { return relative() > 1e-15 || absolute() > 0.0; }

 private:
  void takeOne(double value);

  static constexpr int kDouble = 13;        ///< significant digits from which on it is a double
  static constexpr int kRound = 3;          ///< up to here they are round numbers
  static constexpr int kManyDecimals = 10;  ///< decimals from which on it is no fixed format

  int digits_ = 1;
  int decimals_ = 0;
  bool float32_ = true;
  bool seen_ = false;
};

}  // namespace slamscope::slam
