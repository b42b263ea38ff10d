// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

// Where a drawn cone ends, measured in pictures alone: both of its edges are found by their
// coverage, fitted by lines, and intersected.
namespace slamscope::test {

/// A picture and the same without anything drawn on it (BGR).
struct PicturePair {
  cv::Mat drawn, bare;
};

inline Eigen::Vector3d pixelAt(const cv::Mat& picture, const Eigen::Vector2d& px) {
  const int col = static_cast<int>(std::floor(px.x()));
  const int row = static_cast<int>(std::floor(px.y()));
  if (col < 0 || row < 0 || col + 1 >= picture.cols || row + 1 >= picture.rows) {
    return Eigen::Vector3d::Zero();
  }
  const auto at = [&picture](int x, int y) {
    const cv::Vec3b& p = picture.at<cv::Vec3b>(y, x);
    return Eigen::Vector3d(p[0], p[1], p[2]);
  };
  const double u = px.x() - col;
  const double v = px.y() - row;
  return (1 - u) * (1 - v) * at(col, row) + u * (1 - v) * at(col + 1, row) +
         (1 - u) * v * at(col, row + 1) + u * v * at(col + 1, row + 1);
}

/// Share of the pixel that `colour` covers.
inline double coverage(const PicturePair& pictures, const Eigen::Vector2d& px,
                       const Eigen::Vector3d& colour) {
  const Eigen::Vector3d bare = pixelAt(pictures.bare, px);
  const Eigen::Vector3d full = colour - bare;
  return (pixelAt(pictures.drawn, px) - bare).dot(full) / full.squaredNorm();
}

/// Distance from the axis, to the side `side`, of the cone's edge: the area under its coverage,
/// which neither the width of the anti-aliased edge nor the sampling moves.
inline double edgeAt(const PicturePair& pictures, const Eigen::Vector2d& on_axis,
                     const Eigen::Vector2d& side, const Eigen::Vector3d& colour) {
  constexpr double kStep = 0.05;
  double edge = 0.0;
  for (double t = 0.5 * kStep; t < 14.0; t += kStep) {
    const double share = coverage(pictures, on_axis + t * side, colour);
    if (t > 2.0 && std::abs(share) < 0.01) break;
    edge += kStep * share;
  }
  return edge;
}

/// Intersection of the two edges of the cone whose axis runs from about `tip` towards `rim` (px).
/// Nothing where something else is drawn over it.
inline std::optional<Eigen::Vector2d> measuredTip(const PicturePair& pictures,
                                                  const Eigen::Vector2d& tip,
                                                  const Eigen::Vector2d& rim) {
  const double length = (rim - tip).norm();
  const Eigen::Vector2d axis = (rim - tip) / length;
  const Eigen::Vector2d side(-axis.y(), axis.x());
  const Eigen::Vector3d colour = pixelAt(pictures.drawn, tip + 0.5 * length * axis);
  std::vector<Eigen::Vector2d> left, right;  // (along the axis, off the axis)
  for (double s = 0.22 * length; s < 0.55 * length; s += 0.25) {
    if ((pixelAt(pictures.drawn, tip + s * axis) - colour).norm() > 6.0) return std::nullopt;
    left.emplace_back(s, edgeAt(pictures, tip + s * axis, side, colour));
    right.emplace_back(s, -edgeAt(pictures, tip + s * axis, -side, colour));
  }
  const auto line = [](const std::vector<Eigen::Vector2d>& points) {
    Eigen::MatrixX2d A(points.size(), 2);
    Eigen::VectorXd b(points.size());
    for (Eigen::Index k = 0; k < A.rows(); ++k) {
      A.row(k) << 1.0, points[static_cast<std::size_t>(k)].x();
      b(k) = points[static_cast<std::size_t>(k)].y();
    }
    return Eigen::Vector2d(A.colPivHouseholderQr().solve(b));
  };
  const Eigen::Vector2d l = line(left);
  const Eigen::Vector2d r = line(right);
  const double s = (r(0) - l(0)) / (l(1) - r(1));
  return tip + s * axis + (l(0) + l(1) * s) * side;
}

}  // namespace slamscope::test
