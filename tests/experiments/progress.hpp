// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdio>
#include <mutex>
#include <string>

namespace slamscope::slam::experiments {

/// A line on the terminal that counts up; nothing in a pipe. May be told from any thread.
class Progress {
 public:
  Progress(std::string what, int total)
      : what_(std::move(what)), total_(total), shown_(isatty(STDERR_FILENO) != 0) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }

  void done() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (shown_) std::fprintf(stderr, "\r%s: %d of %d", what_.c_str(), done_, total_);
  }

 private:
  std::mutex mutex_;
  std::string what_;
  int total_;
  int done_ = 0;
  bool shown_;
};

}  // namespace slamscope::slam::experiments
