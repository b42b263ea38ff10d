// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam {

/// What was decided of one reading, and all that was decided before: hypotheses of common descent
/// share the common part.
struct Decision {
  static constexpr std::size_t kJoin = static_cast<std::size_t>(-1);

  Decision(std::shared_ptr<Decision> decided_before, std::size_t of_reading, FeatureId of_feature,
           FeatureId joined_into = 0)
      : before(std::move(decided_before)),
        reading(of_reading),
        feature(of_feature),
        into(joined_into) {}
  Decision(const Decision&) = delete;
  Decision& operator=(const Decision&) = delete;
  /// Without recursion, which would go as deep as there were readings.
  ~Decision();

  std::shared_ptr<Decision> before;
  std::size_t reading;  ///< which one; kJoin: two features became one
  FeatureId feature;    ///< that it is of; of a join: the one that went
  FeatureId into;       ///< of a join: the one that stayed
};

/// A reading on its way through the hypotheses.
struct Reading {
  std::size_t number = 0;  ///< in order of the recording
  std::chrono::nanoseconds time{};
  Observation observation;  ///< its id: what a feature is called that it begins
};

/// What a hypothesis remembers of a feature.
struct FeatureMemory {
  std::chrono::nanoseconds last{};  ///< when it was read last
  double last_error = 0.0;          ///< m, of that range, as far as one knows
  /// What its being in view beside others has cost in score so far: were it one of those, each
  /// choice would have been among one feature less.
  double choice_cost = 0.0;
};

/// One story of which feature each reading was of: the EKF that results, and how likely it makes
/// all readings (Reid, "An algorithm for tracking multiple targets", IEEE TAC 24(6), 1979; on maps:
/// Cox and Leonard, "Modeling a dynamic environment using a Bayesian multiple hypothesis approach",
/// Artificial Intelligence 66, 1994). A value: a copy goes its own way.
struct Hypothesis {
  EkfState state;                       ///< of P, only the lower triangle
  std::vector<FeatureMemory> memories;  ///< in the state's order
  double score = 0.0;                   ///< log-likelihood, less a constant that all have in common
  std::vector<FeatureId> seen_now;      ///< features that were read at this time
  /// Pairs (smaller id first, sorted) that were read at one time: they are not the same.
  std::vector<std::pair<FeatureId, FeatureId>> together;
  std::shared_ptr<Decision> newest;

  /// At the origin, with an empty map.
  [[nodiscard]] static Hypothesis atOrigin(const Eigen::Vector3d& initial_sigma);

  [[nodiscard]] bool sawNow(FeatureId feature) const;
  [[nodiscard]] bool sawTogether(FeatureId a, FeatureId b) const;

  /// The reading is of the feature at place `index` of the state's order.
  void pair(EkfEquations& equations, std::size_t index, const Reading& reading);
  /// It is of a new feature.
  void begin(EkfEquations& equations, const Reading& reading);
  /// Notes which features were seen together at this time, and goes on to the next.
  void endTime();

  /// How far apart two features are (a − b), and the covariance of that.
  struct Distance {
    Eigen::Vector2d mean;
    Eigen::Matrix2d covariance;
  };
  [[nodiscard]] Distance distance(std::size_t a, std::size_t b) const;
  /// Features at places `stays` and `goes` are one: the exact constraint "their distance is 0 ± σ",
  /// of which `apart` is what distance() says, with σ² added to the covariance.
  void join(std::size_t stays, std::size_t goes, const Distance& apart);

  /// Which feature of the final map each of `count` readings is of, 0: none.
  [[nodiscard]] std::vector<FeatureId> labels(std::size_t count) const;
};

/// How near two hypotheses must be to go on as one: squared Mahalanobis distances of pose (3
/// degrees of freedom) and of each feature (2).
struct Likeness {
  double pose = 3.0;
  double feature = 4.0;
};

/// Whether two hypotheses believe in the same map and pose, whatever they call the features.
[[nodiscard]] bool alike(const Hypothesis& a, const Hypothesis& b, const Likeness& likeness);

}  // namespace slamscope::slam
