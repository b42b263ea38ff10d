// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam {

/// How it is found out which feature a reading is of: by the ids of the readings; the likeliest
/// individually compatible feature; or the likeliest jointly compatible set of pairings.
enum class Association { known, nearest, joint };

/// χ² gates, given by the share of right pairings that they let through. What is compared with the
/// quantile is the squared Mahalanobis distance, of 2 degrees of freedom a pairing.
struct AssociationGates {
  double pair = 0.99;  ///< inside: compatible
  /// Outside of this wider ellipse of every feature, but for those that other readings of the same
  /// time are of: a new feature. A reading between the two is ambiguous: it neither corrects nor
  /// makes a feature.
  double fresh = 0.9999;
  /// Features a m² of floor that the map does not have yet, as far as one knows. A reading is
  /// paired only where it is likelier to be of that feature, N(ν; 0, S), than of one of these:
  /// after a long blind drive nearly everything is inside of a gate. Next to nothing: pairs as many
  /// as it can.
  double fresh_density = 1e-9;
  /// A pairing counts only where the readings are so many times likelier with it than with what
  /// rivals it: a new feature, another feature for the same reading (nearest), another set of
  /// pairings (joint). 1: whatever is best is taken. A wrong pairing costs more than one that is
  /// left out.
  double odds = 1.0;
  /// Pairings that a joint search may try before the best set found so far is taken.
  int search_limit = 20000;
};

/// What the readings of one time are of.
struct Matches {
  static constexpr int kFresh = -1;      ///< of a feature that the map doesn't have
  static constexpr int kAmbiguous = -2;  ///< can't be told

  std::vector<int> feature;  ///< of each reading: index in state order, or one of the above
  std::vector<bool> hinted;  ///< of each feature: a reading lies in its wider ellipse
  /// Log of how many times likelier the readings are with the pairings than if all were of new
  /// features.
  double gain = 0.0;
  bool cut_short = false;  ///< a joint search reached its limit
};

/// What a sensor would read off a feature, and how sure the filter is of that.
struct ExpectedReading {
  Eigen::Vector2d z = Eigen::Vector2d::Zero();     ///< (6)
  Matrix23d H_v = Matrix23d::Zero();               ///< ∂z/∂pose
  Eigen::Matrix2d H_f = Eigen::Matrix2d::Zero();   ///< ∂z/∂feature
  Eigen::Matrix2d HPHt = Eigen::Matrix2d::Zero();  ///< S of (8) but for R
};

/// Expected readings of all features, in state order. O(n).
[[nodiscard]] std::vector<ExpectedReading> expectedReadings(const EkfState& state, Sensor sensor);

/// Finds pairings of readings with features; ids of readings are not looked at. No feature is
/// paired twice. `expected` is expectedReadings() of the same state.
///
/// Throws std::invalid_argument unless 0 < pair ≤ fresh < 1 ≤ odds, for Association::known, and for
/// a sensor that is not known.
class Associator {
 public:
  Associator(Sensor sensor, Association association, const AssociationGates& gates);

  [[nodiscard]] Matches match(const EkfState& state, std::span<const ExpectedReading> expected,
                              std::span<const Observation> readings) const;

 private:
  Sensor sensor_;
  Association association_;
  AssociationGates gates_;
  double fresh_quantile_;
  double margin_;                      ///< of log-likelihoods: ln odds
  std::vector<double> pair_quantile_;  ///< of 2, 4, 6 … degrees of freedom
};

}  // namespace slamscope::slam
