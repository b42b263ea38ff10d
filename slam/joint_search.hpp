// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam/association.hpp"

namespace slamscope::slam {

/// A reading and a feature that are individually compatible.
struct Pairing {
  int reading = 0;
  int feature = 0;  ///< index in state order
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  double squared_distance = 0.0;
};

/// Joint compatibility branch and bound (Neira and Tardós, "Data association in stochastic mapping
/// using the joint compatibility test", IEEE TRA 17(6), 2001): the largest set of pairings, each
/// reading and each feature in one at most, whose joint squared Mahalanobis distance is inside its
/// gate; of sets of one size, that of the least distance, less what close rivals dispute. The
/// distance is grown a pairing at a time by the next two rows of the Cholesky factor of the joint
/// S.
class JointSearch {
 public:
  struct Result {
    /// Of the best set, without those that a rival disagrees with.
    std::vector<Pairing> pairings;
    double squared_distance = 0.0;
    bool cut_short = false;  ///< `limit` was reached, the best so far stands
  };

  /// Readings beyond so many that have a compatible feature are left out of a search.
  static constexpr std::size_t kMostReadings = 64;

  struct Limits {
    /// [k]: gate of k + 1 pairings, 2 (k + 1) degrees of freedom; kMostReadings many.
    std::span<const double> quantiles;
    /// A rival of the best set has as many pairings, and at most so much more squared distance.
    double margin = 0.0;
    int tries = 0;  ///< pairings tried
  };

  JointSearch(const EkfState& state, std::span<const ExpectedReading> expected,
              std::span<const Observation> readings, const Limits& limits);

  [[nodiscard]] Result run(std::vector<Pairing> compatible);

 private:
  void branch(std::size_t group);
  [[nodiscard]] bool push(const Pairing& pairing);
  void keep();
  void strikeDisputed();
  [[nodiscard]] Eigen::Matrix2d crossCovariance(int a, int b) const;

  const EkfState& state_;
  std::span<const ExpectedReading> expected_;
  std::span<const Observation> readings_;
  Limits limits_;
  std::vector<Result> rivals_;                ///< sets that may rival the best one, and it
  std::vector<std::vector<Pairing>> groups_;  ///< by reading
  std::vector<Pairing> current_;
  std::vector<double> squared_;  ///< after each of `current_`
  Eigen::MatrixXd L_;            ///< factor of the joint S of `current_`
  Eigen::VectorXd whitened_;     ///< L⁻¹ ν
  Result best_;
};

}  // namespace slamscope::slam
