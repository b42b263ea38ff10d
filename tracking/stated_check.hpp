// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <span>
#include <string>

#include "tracking/head_fit.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

/// Whether what was stated of one camera and of the tags explains what is seen. Over pictures from
/// different places, each picture's own pose taken out of the least squares (Schur complement), it
/// asks what one change would explain the residuals: another focal length, another principal point
/// (half a pixel, say), another size of all tags. All corners take part, those least that are
/// further off than most: where a camera is badly known the fit leaves nearly everything out.
class StatedCheck {
 public:
  /// `camera`: how it is called, "the left camera".
  explicit StatedCheck(std::string camera) : camera_(std::move(camera)) {}

  /// The corners of three tags or more in one picture, and the head as it was fitted to them. What
  /// explains them is asked of pictures only between which the head has moved: biases of one view
  /// must not count many times.
  void add(const EyeCamera& eye, const TagLayout& layout, std::span<const HeadSight> sights,
           const HeadMotion& head, std::size_t camera);

  /// "focal length of the left camera looks 2.1 % longer than stated", "principal point of the left
  /// camera looks 0.5, 0.5 px off: are pixels counted from their centres?", "tags look 2.0 % larger
  /// than stated"; where none of these explains it "corners in the picture of the left camera lie
  /// 2.3 px off: its lens, its readout or the layout is not as stated". Nothing where all is well,
  /// or too little was seen to tell.
  [[nodiscard]] std::optional<std::string> named() const;

 private:
  void learn(const EyeCamera& eye, const TagLayout& layout, std::span<const HeadSight> sights,
             const HeadMotion& head);
  [[nodiscard]] std::optional<std::string> explained() const;
  [[nodiscard]] std::optional<std::string> unexplained() const;

  std::string camera_;
  std::deque<double> medians_px_;  // of the corners' distances in the last pictures
  // Least squares over focal length (logarithm), principal point u, v (px), size of the tags
  // (logarithm), what the poses can explain taken out.
  Eigen::Matrix4d H_ = Eigen::Matrix4d::Zero();
  Eigen::Vector4d g_ = Eigen::Vector4d::Zero();
  double chi2_ = 0;  // left by the poses
  double dof_ = 0;
  double pictures_ = 0;
  std::optional<Eigen::Isometry3d> before_;
};

}  // namespace slamscope::tracking
