// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "tracking/head_fit.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

/// What one camera saw, with its exposure after the moment that is asked for.
struct EyeSight {
  std::size_t camera = 0;
  double delay = 0;  ///< of the middle row, s
  std::span<const TagDetection> tags;
};

/// The corners of all tags that the layout has, ready for fitHead. A tag seen twice is there twice,
/// as two squares.
[[nodiscard]] std::vector<HeadSight> sightsOf(std::span<const EyeCamera> eyes,
                                              const TagLayout& layout,
                                              std::span<const EyeSight> pictures,
                                              double corner_bias_px);

struct HeadStartOptions {
  std::chrono::nanoseconds time{};
  double gate_sigmas = 6;
  double sigma_v = 0.8, sigma_omega = 1.6;      ///< how heads move, m/s and rad/s
  double sigma_alpha = 5.0, sigma_jerk = 30.0;  ///< rad/s², rad/s³
  /// Whether a head may be there at all: decides where one may and another may not.
  std::function<bool(const Eigen::Isometry3d& T_world_head)> plausible;
};

/// Heads that fit what was seen, from nothing: best first, at most two. A second one is there only
/// where the first isn't decidedly better (a lone tag looked at from afar): both must then be
/// carried on. Empty where nothing fits.
[[nodiscard]] std::vector<HeadFit> findHead(std::span<const EyeCamera> eyes,
                                            const TagLayout& layout,
                                            std::span<const EyeSight> pictures,
                                            std::span<const HeadSight> sights,
                                            const HeadStartOptions& options);

/// The pose that fits a lone tag as well as `motion` does, from the other side of the planar
/// ambiguity (T_world_head); nothing where there is none.
[[nodiscard]] std::vector<Eigen::Isometry3d> otherPoses(std::span<const EyeCamera> eyes,
                                                        const TagLayout& layout,
                                                        std::span<const EyeSight> pictures,
                                                        const HeadMotion& motion);

}  // namespace slamscope::tracking
