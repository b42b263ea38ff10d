// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "tracking/head_history.hpp"
#include "tracking/head_start.hpp"

namespace slamscope::tracking {

/// One step of the filter: what the pictures of a moment make of what was known before them.
class HeadStep {
 public:
  HeadStep(std::span<const EyeCamera> eyes, const TagLayout& layout,
           const HeadTrackerOptions& options)
      : eyes_(eyes), layout_(layout), options_(options) {}

  /// Fills in what is known after the moment's pictures. `before`: the moment before, or null.
  void evaluate(const HeadMoment* before, HeadMoment& moment) const;
  [[nodiscard]] const HeadTrackerOptions& options() const { return options_; }

 private:
  struct Update;  // the moment's sights, and the fits so far
  [[nodiscard]] bool plausible(const Eigen::Isometry3d& T_world_head) const;
  [[nodiscard]] std::vector<HeadHypothesis> predictedHeads(const HeadMoment* before,
                                                           std::chrono::nanoseconds time) const;
  void update(Update& update) const;
  void doubt(Update& update) const;
  void considerOthers(Update& update) const;
  void start(Update& update) const;
  void conclude(Update& update, HeadMoment& moment) const;

  std::span<const EyeCamera> eyes_;
  const TagLayout& layout_;
  HeadTrackerOptions options_;
};

}  // namespace slamscope::tracking
