// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "slam/models.hpp"

namespace slamscope::slam {

/// How readings of range and bearing err. What makes a range wrong – the post's thickness, light,
/// a pattern seen aslant – stays while the robot looks at the feature: a first-order Markov error
/// (Gelb, "Applied Optimal Estimation", 1974, section 3.6). Taken for white noise, a hundred
/// readings within seconds would make a filter sure of a range that is 0.2 m off, and each further
/// reading would count as evidence of its own for whatever was decided first.
struct ReadingErrorOptions {
  /// σ of a range (m) is `range_sigma` + `range_share` × range; of a bearing (rad) `bearing_sigma`.
  /// The figures of a camera that reads barcodes 1 to 3 m away: 0.15 to 0.25 m, 0.02 rad (MR.CLAM
  /// against its truth: 0.12 to 0.20 m, 0.009 to 0.027 rad).
  double range_sigma = 0.10;
  double range_share = 0.05;
  double bearing_sigma = 0.02;
  /// s, after which 1/e of a feature's range error is left. 0: white.
  double memory = 3.0;
  /// s, the same for corrections of the map: a part of the error stays for as long as the robot
  /// looks from the same side. 0: white.
  double slow_memory = 15.0;
  /// Share of readings whose range error has nothing to do with the one before.
  double jump_share = 0.1;

  /// With another memory; the slow one keeps its ratio to it.
  [[nodiscard]] ReadingErrorOptions withMemory(double seconds) const;
};

/// A reading beside what a filter expected of some feature.
struct ComparedReading {
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d HPHt = Eigen::Matrix2d::Zero();  ///< what the map is unsure of
  Eigen::Matrix2d R = Eigen::Matrix2d::Zero();     ///< of the reading taken alone
  double last_error = 0.0;                         ///< m, of the feature's last range,
  double since = 0.0;                              ///< so many s ago
};

/// Readings of range and bearing under that error.
class ReadingError {
 public:
  /// Throws std::invalid_argument where a σ is not above 0, a time is negative or a share is not
  /// one.
  explicit ReadingError(const ReadingErrorOptions& options);

  /// Covariance of one reading taken alone.
  [[nodiscard]] Eigen::Matrix2d covariance(double range) const;

  /// `R` of a correction, `since` s after the feature's last reading: such that many readings make
  /// the feature as sure as the mean of so many correlated ones is.
  [[nodiscard]] Eigen::Matrix2d correctionCovariance(const Eigen::Matrix2d& R, double since) const;

  /// ln p(ν).
  [[nodiscard]] double logLikelihood(const ComparedReading& reading) const;

 private:
  ReadingErrorOptions options_;
};

/// ln N(ν; 0, S); minus infinity where S is not positive definite.
[[nodiscard]] double logNormal(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S);

}  // namespace slamscope::slam
