// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <vector>

#include "slam/association.hpp"
#include "slam/dead_reckoning.hpp"
#include "slam/ekf_equations.hpp"
#include "slam/hypothesis.hpp"
#include "slam/reading_error.hpp"
#include "slam/recording.hpp"
#include "slam/view_limits.hpp"

namespace slamscope::slam {

/// How many stories of the readings are kept side by side, and what they are judged by. Where a
/// filter may be careful and take its noise wide, a judge must not: these are the errors as they
/// are. The defaults are those of MR.CLAM's robots.
struct HypothesisOptions {
  int most = 0;  ///< hypotheses kept; 0: nothing is searched
  ReadingErrorOptions error{};
  /// Of odometry, as DeadReckoning has it: forward (m), sideways (m), turn (rad) after 1 s.
  Eigen::Vector3d odometry_sigma{0.015, 0.005, 0.02};
  /// rad, what turning by 1 rad adds to that; it grows with the root. Wheels slip when they turn.
  double turn_sigma = 0.12;
  /// How often a reading is of a feature that the map does not have yet, a m² of floor. A feature
  /// is begun once and read a hundred times, so this is far less than how densely they stand; too
  /// much of it maps features twice (tests/experiments/README.md).
  double fresh_density = 2e-5;
  /// Where a feature has to stand so that a reading may well be of it: so many features, so many
  /// equally likely choices.
  ViewLimits view{7.0, 0.5};
  double gate_probability = 0.99995;  ///< of readings with features, and of two features being one
  double same_place = 0.03;           ///< m, σ of the distance of two features that are one
  double least_odds = 1e-6;           ///< hypotheses less likely than the best by more are dropped
  Likeness likeness{};                ///< of two alike the likelier one goes on
  /// Readings without which a feature of the best hypothesis is none.
  int confirm_after = 4;
};

/// Multi-hypothesis data association over a recording of range and bearing (Reid 1979; Cox and
/// Hingorani, "An efficient implementation of Reid's multiple hypothesis tracking algorithm", IEEE
/// TPAMI 18(2), 1996). Each reading forks each hypothesis: it is of one of the features inside the
/// gate, or of a new one. Two features that were never seen at one time may be the same: one more
/// fork. The likelihood of all readings decides – at the end, so that what was taken for something
/// else for want of knowledge is put right by what came later.
///
/// Time grows with hypotheses × features² a reading: for maps of some tens of features.
class HypothesisSearch {
 public:
  /// A hypothesis with more features than this would take forever.
  static constexpr int kMostFeatures = 200;

  /// `recording` must outlive this. Throws std::invalid_argument for a sensor other than range and
  /// bearing, for scans, and for options out of range.
  HypothesisSearch(const Recording& recording, const Eigen::Vector3d& initial_sigma,
                   const HypothesisOptions& options);

  /// Goes through the whole recording. Of each reading, sightings in order, the feature that the
  /// best hypothesis takes it for: 1, 2, 3 … in order of appearance, 0 for features that were read
  /// less than `confirm_after` times. Throws std::runtime_error beyond kMostFeatures.
  [[nodiscard]] std::vector<FeatureId> run();

 private:
  struct Fork {
    std::size_t parent = 0;
    int feature = Matches::kFresh;  ///< place in the parent's state
    double score = 0.0;
  };

  void predictTo(std::chrono::nanoseconds time);
  void read(const Sighting& sighting, std::chrono::nanoseconds time);
  void addForks(std::size_t parent, const Reading& reading);
  [[nodiscard]] Hypothesis child(const Fork& fork, const Reading& reading);
  [[nodiscard]] bool inGate(const Eigen::Vector2d& innovation, const Eigen::Matrix2d& S) const;
  void addJoins(std::size_t parent);
  void keepBest();

  const Recording& recording_;
  HypothesisOptions options_;
  EkfEquations equations_;
  ReadingError error_;
  DeadReckoning dead_reckoning_;
  double gate_;
  double drop_;  ///< of scores
  std::vector<Hypothesis> hypotheses_;
  std::vector<Fork> forks_;
  std::vector<std::vector<std::size_t>> in_view_;  ///< of each hypothesis, at this reading
  std::chrono::nanoseconds time_;
  std::size_t number_ = 0;  ///< of the next reading
  FeatureId last_name_ = 0;
};

}  // namespace slamscope::slam
