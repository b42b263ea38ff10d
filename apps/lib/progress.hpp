// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

namespace slamscope::apps {

/// One line on the terminal that says how far long work is; silent in a pipe.
class Progress {
 public:
  explicit Progress(std::string title);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// `done` in [0, 1]; `detail` is put behind it. Redraws at most ten times a second.
  void show(double done, const std::string& detail = {});
  /// Where the end is not known: the detail alone.
  void show(const std::string& detail);

 private:
  void print(const std::string& line);

  std::string title_;
  bool terminal_;
  bool printed_ = false;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace slamscope::apps
