// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "apps/lib/view/alarm_marks.hpp"
#include "engine/render/offscreen.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::apps {

/// What was drawn last, and of what.
struct DrawnMoment {
  engine::Offscreen& offscreen;
  const engine::Scene& scene;
  const slam::Snapshot& snapshot;  ///< that the scene shows
  const AlarmMarks& alarms;
};

/// What is seen at a pixel of a view (OpenCV's convention) or within a few pixels of it, in a line
/// for people: "feature 12: 3.1 cm × 1.2 cm (1σ)", "features 3 and 7: relative …", or that there is
/// nothing.
[[nodiscard]] std::string whatIsAt(const Eigen::Vector2d& pixel, std::uint32_t view,
                                   const DrawnMoment& drawn);

}  // namespace slamscope::apps
