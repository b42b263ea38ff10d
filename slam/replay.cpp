// SPDX-License-Identifier: MIT
#include "slam/replay.hpp"

#include <utility>

namespace slamscope::slam {

Replay::Replay(RunReader reader) : reader_(std::move(reader)) {}

bool Replay::step() {
  if (!peek()) return false;
  publish(std::exchange(ahead_, nullptr));
  return true;
}

std::size_t Replay::advanceTo(std::chrono::nanoseconds time) {
  std::size_t published = 0;
  while (peek() && ahead_->time <= time) {
    step();
    ++published;
  }
  return published;
}

std::optional<std::chrono::nanoseconds> Replay::nextTime() {
  if (!peek()) return std::nullopt;
  return ahead_->time;
}

const SnapshotPtr& Replay::peek() {
  if (!ahead_) ahead_ = reader_.next().value_or(nullptr);
  return ahead_;
}

}  // namespace slamscope::slam
