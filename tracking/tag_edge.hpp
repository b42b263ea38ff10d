// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "tracking/image_view.hpp"

namespace slamscope::tracking {

/// A side of a square as it is believed to be: from corner to corner, with its own axes.
struct Chord {
  Chord(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
      : first(from),
        last(to),
        middle((from + to) / 2),
        direction((to - from).normalized()),
        normal(direction.y(), -direction.x()),
        half((to - from).norm() / 2) {}

  [[nodiscard]] double along(const Eigen::Vector2d& p) const { return direction.dot(p - middle); }
  [[nodiscard]] double across(const Eigen::Vector2d& p) const { return normal.dot(p - middle); }

  Eigen::Vector2d first, last, middle, direction, normal;  ///< px
  double half;                                             ///< half its length, px
};

/// How far a line that is straight in the world lies off the chord: (1 − u²)(a + b u + c u²) with u
/// from −1 to 1 along it, px.
struct Bow {
  Eigen::Vector3d abc = Eigen::Vector3d::Zero();
  [[nodiscard]] double at(double u) const {
    return (1 - u * u) * (abc[0] + u * (abc[1] + u * abc[2]));
  }
};

/// On both sides of an edge; ahead is where its normal points.
struct GreyLevels {
  double behind = 0, ahead = 0;
};

/// The pixels that take part, and what is known of them.
struct EdgeWindow {
  double half_width = 3;                           ///< to both sides of the edge, px
  double margin = 2;                               ///< left out at each end, px
  std::optional<GreyLevels> known = std::nullopt;  ///< instead of being fitted
};

struct EdgeFit {
  Eigen::Vector2d point, normal;  ///< of the line that passes the ends of the side (bow taken off)
  double blur = 0;                ///< standard deviation of the point spread, px
  GreyLevels levels;              ///< in its middle
  double contrast = 0;            ///< grey levels, across the edge along the normal
  double half = 0;                ///< px
  Eigen::Matrix2d covariance;     ///< of offset (px) and slope (px at the end of the side)

  [[nodiscard]] double varianceAt(
      const Eigen::Vector2d& p) const;  ///< of the line's place there, px²
};

/// Fits a blurred step to the pixels about the chord. Nothing where the window leaves the picture,
/// the contrast is too low, or the fit comes to no rest within the window.
[[nodiscard]] std::optional<EdgeFit> fitEdge(const ImageView& grey, const Chord& chord,
                                             const Bow& bow, const EdgeWindow& window);

}  // namespace slamscope::tracking
