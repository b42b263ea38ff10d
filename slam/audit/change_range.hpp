// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "slam/audit/span_fit.hpp"
#include "slam/audit/transition.hpp"

namespace slamscope::slam {

/// An orthonormal basis of range(D), found by random probes: the part of it that stands out of the
/// noise. D scaled, all states.
struct ChangeRange {
  Eigen::MatrixXd Q;      ///< N × rank
  bool complete = false;  ///< rank is less than the number of probes, so nothing is missing
  double noise = 0.0;     ///< error of Q's entries, about
};

/// With at least `rank` + 3 probes; more where these do not suffice, up to `most`.
[[nodiscard]] ChangeRange rangeOfChange(const Transition& transition, int rank, int most);

/// Where the filter linearised feature `index`: the δ for which P⁻B(δ)ᵀ lies in the range, absent
/// where none does or P⁻e_θ itself lies there. `written`: the feature whose block H was written to.
[[nodiscard]] std::optional<Eigen::Vector2d> linearisedAt(const Transition& transition,
                                                          const ChangeRange& range, int written);

/// Part of P⁻B(δ)ᵀ of a feature that lies outside of the range: 0 to 1, the larger of its columns.
[[nodiscard]] double shareOutside(const Transition& transition, const ChangeRange& range,
                                  int feature, const Eigen::Vector2d& delta);

/// Whether P⁻B(δ)ᵀ of a feature lies in the range.
[[nodiscard]] bool contains(const Transition& transition, const ChangeRange& range, int feature,
                            const Eigen::Vector2d& delta);

}  // namespace slamscope::slam
