// SPDX-License-Identifier: MIT
#include "apps/lib/progress.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace slamscope::apps {

Progress::Progress(std::string title)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (printed_) std::fputs("\r\x1b[K", stderr);
}

void Progress::show(double done, const std::string& detail) {
  print(title_ + "  " + std::to_string(std::lround(100.0 * done)) + " %  " + detail);
}

void Progress::show(const std::string& detail) {
  print(title_ + "  " + detail);
}

void Progress::print(const std::string& line) {
  if (!terminal_) return;
  const auto now = std::chrono::steady_clock::now();
  if (printed_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  printed_ = true;
  std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
  std::fflush(stderr);
}

}  // namespace slamscope::apps
