// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <vector>

#include "tracking/head_fit.hpp"
#include "tracking/head_tracker.hpp"

namespace slamscope::tracking {

/// Where the head may be: one of one or two, with what was held against it.
struct HeadHypothesis {
  HeadMotion motion;
  double score = 0;  ///< sum of HeadFit::cost, less the best one's
};

/// Pictures exposed together, and what is known of the head then.
struct HeadMoment {
  std::chrono::nanoseconds time{};  ///< mid-exposure of the first of them
  std::vector<HeadPicture> pictures;
  // After them:
  std::vector<HeadHypothesis> heads;     ///< none: searching. Best first
  std::chrono::nanoseconds last_seen{};  ///< when tags counted last
  HeadFix fix;
  std::vector<HeadSight> sights;  ///< what fit->used speaks of
  std::optional<HeadFit> fit;     ///< of the best head; absent where no tag counted
};

/// The moments of the last second or so, in order of time.
class HeadHistory {
 public:
  explicit HeadHistory(std::chrono::nanoseconds length) : length_(length) {}

  /// Adds a picture to the moment that is at most `together` before or after it, or as a moment of
  /// its own. From the one returned on, all are to be evaluated again.
  std::size_t put(HeadPicture picture, std::chrono::nanoseconds together);
  /// Drops moments older than the newest by more than the length (but not the newest).
  void forget();

  /// Pictures before this time come too late: their place is forgotten already.
  [[nodiscard]] std::chrono::nanoseconds begins() const;
  [[nodiscard]] bool has(std::size_t camera, std::chrono::nanoseconds time) const;
  [[nodiscard]] const HeadMoment* before(std::chrono::nanoseconds time) const;  ///< or at it
  [[nodiscard]] const HeadMoment* find(std::chrono::nanoseconds time) const;
  [[nodiscard]] std::deque<HeadMoment>& moments() { return moments_; }
  [[nodiscard]] const std::deque<HeadMoment>& moments() const { return moments_; }

 private:
  std::chrono::nanoseconds length_;
  std::deque<HeadMoment> moments_;
};

}  // namespace slamscope::tracking
