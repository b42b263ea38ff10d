// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

namespace slamscope::slam {

/// A reading and a feature that are individually compatible.
struct Pairing {
  int reading = 0;
  int feature = 0;  ///< index in state order
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  double bonus = 0.0;  ///< −ln (2π × density of readings of new features) at the reading
  double gain = 0.0;   ///< log-likelihood of this pairing beyond that of a new feature
  double most = 0.0;   ///< no gain that it brings into a set is more
};

/// Joint compatibility branch and bound (Neira and Tardós, "Data association in stochastic mapping
/// using the joint compatibility test", IEEE TRA 17(6), 2001): of the sets of pairings, each
/// reading and each feature in one at most, whose joint squared Mahalanobis distance is inside its
/// gate, the likeliest, less what close rivals dispute. A set's gain in log-likelihood over "all
/// are of new features" is Σ bonus − ½ (d² + ln |S|), d² and S joint: where new features are rare
/// that is the largest set. Both grow a pairing at a time by the next two rows of the Cholesky
/// factor of S.
class JointSearch {
 public:
  struct Result {
    /// Of the best set, without those that a rival disagrees with.
    std::vector<Pairing> pairings;
    double gain = 0.0;
    bool cut_short = false;  ///< `limit` was reached, the best so far stands
  };

  /// Readings beyond so many that have a compatible feature are left out of a search.
  static constexpr std::size_t kMostReadings = 64;

  struct Limits {
    /// [k]: gate of k + 1 pairings, 2 (k + 1) degrees of freedom; kMostReadings many.
    std::span<const double> quantiles;
    double margin = 0.0;  ///< a rival of the best set has at most so much less gain
    int tries = 0;        ///< pairings tried
  };

  /// Covariance of the innovations of two pairings; of one with itself: its S.
  using Covariance = std::function<Eigen::Matrix2d(const Pairing& a, const Pairing& b)>;

  JointSearch(Covariance covariance, const Limits& limits);

  [[nodiscard]] Result run(std::vector<Pairing> compatible);

 private:
  struct Sums {
    double squared = 0.0;  ///< joint squared distance
    double gain = 0.0;
  };
  [[nodiscard]] Sums sums() const { return sums_.empty() ? Sums{} : sums_.back(); }
  void branch(std::size_t group);
  [[nodiscard]] bool push(const Pairing& pairing);
  void keep();
  void strikeDisputed();

  Covariance covariance_;
  Limits limits_;
  std::vector<Result> rivals_;                ///< sets that may rival the best one, and it
  std::vector<std::vector<Pairing>> groups_;  ///< by reading
  std::vector<Pairing> current_;
  std::vector<Sums> sums_;    ///< after each of `current_`
  std::vector<double> hope_;  ///< [k]: gain that groups from k on can still add at most
  Eigen::MatrixXd L_;         ///< factor of the joint S of `current_`
  Eigen::VectorXd whitened_;  ///< L⁻¹ ν
  Result best_;
};

}  // namespace slamscope::slam
