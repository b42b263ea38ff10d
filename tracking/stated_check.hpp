// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>

#include "tracking/head_fit.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

/// Whether what was stated of one camera and of the tags explains what is seen. Over pictures from
/// different places, each picture's own pose taken out of the least squares (Schur complement), it
/// asks what one change would explain the residuals: another focal length, another principal point
/// (half a pixel, say), another size of all tags.
class StatedCheck {
 public:
  explicit StatedCheck(std::string camera) : camera_(std::move(camera)) {}

  /// A picture's corners at the fit's time, those that the fit uses. Passed over where the head has
  /// hardly moved since the picture before: biases of one view must not count many times.
  void add(const EyeCamera& eye, const TagLayout& layout, std::span<const HeadSight> sights,
           const HeadFit& fit, std::size_t camera);

  /// "focal length of the left camera looks 2.1 % longer than stated", "principal point of the left
  /// camera looks 0.5, 0.5 px off: are pixels counted from their centres?", "tags look 2.0 % larger
  /// than stated". Nothing where all is well, or too little was seen to tell.
  [[nodiscard]] std::optional<std::string> named() const;

 private:
  // focal length (logarithm), principal point u, v (px), size of the tags (logarithm)
  static constexpr int kSize = 4;
  using Matrix4 = Eigen::Matrix<double, kSize, kSize>;
  using Vector4 = Eigen::Matrix<double, kSize, 1>;

  std::string camera_;
  Matrix4 H_ = Matrix4::Zero();
  Vector4 g_ = Vector4::Zero();
  double chi2_ = 0;  // left by the poses
  double dof_ = 0;
  double pictures_ = 0;
  std::optional<Eigen::Isometry3d> before_;
};

}  // namespace slamscope::tracking
