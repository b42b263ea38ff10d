// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace slamscope::engine {

/// n points of a plane, jointly Gaussian: their means and the lower half of the 2n × 2n covariance
/// in single precision, in the order in which the device reads it. Immutable: whoever has new
/// estimates makes new points, and a renderer uploads each of them once.
///
/// What is drawn depends on differences of points alone, so both are stored relative to the first
/// point, by subtraction in double precision: its mean from the means, its covariance block from
/// every block. Differences of points (and of blocks, P_ii + P_jj − P_ij − P_ji) are unchanged by
/// that, and what all points have in common does not eat the digits of single precision.
///
/// Names say which point is which in other PlanarPoints (MostBy::growth).
class PlanarPoints {
 public:
  /// `packed`: lower triangle of a symmetric matrix, row by row ((0,0) (1,0) (1,1) (2,0) …) in m²,
  /// of which the points' rows begin at `first_row` (x, y of the first point, x, y of the second
  /// …). Throws std::invalid_argument where the triangle ends before the last point's rows.
  /// `names`: one a point, all different; none: their indices.
  PlanarPoints(std::span<const Eigen::Vector2d> means, std::span<const double> packed,
               int first_row = 0, std::span<const std::uint64_t> names = {});

  [[nodiscard]] int count() const { return static_cast<int>(means_.size()); }
  [[nodiscard]] std::size_t pairCount() const {
    return means_.size() * (means_.size() - (means_.empty() ? 0 : 1)) / 2;
  }
  /// m; what `means` are relative to.
  [[nodiscard]] const Eigen::Vector2d& origin() const { return origin_; }
  [[nodiscard]] std::span<const Eigen::Vector2f> means() const { return means_; }
  /// Block (j, i), i ≤ j, at j (j + 1) / 2 + i, each row by row.
  [[nodiscard]] std::span<const Eigen::Vector4f> blocks() const { return blocks_; }
  [[nodiscard]] std::span<const std::uint64_t> names() const { return names_; }
  [[nodiscard]] std::size_t bytes() const {
    return means_.size() * sizeof(Eigen::Vector2f) + blocks_.size() * sizeof(Eigen::Vector4f);
  }

 private:
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  std::vector<Eigen::Vector2f> means_;
  std::vector<Eigen::Vector4f> blocks_;
  std::vector<std::uint64_t> names_;
};

using PlanarPointsPtr = std::shared_ptr<const PlanarPoints>;

}  // namespace slamscope::engine
