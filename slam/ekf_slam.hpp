// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf_equations.hpp"
#include "slam/models.hpp"
#include "slam/snapshot.hpp"
#include "slam/subject.hpp"

namespace slamscope::slam {

/// All observations of a time step in one update, or one after the other.
enum class UpdateMode { batch, sequential };

struct EkfOptions {
  Sensor sensor = Sensor::range_bearing;
  UpdateMode update = UpdateMode::batch;
  /// Observations outside the χ² ellipse that holds this share of the probability (0.99, say) are
  /// left out of the update and counted. No gate where absent.
  std::optional<double> gate_probability{};
  Eigen::Vector3d initial_pose = Eigen::Vector3d::Zero();        ///< x, y (m), θ (rad)
  Eigen::Matrix3d initial_covariance = Eigen::Matrix3d::Zero();  ///< zero: exactly known
  int threads = 2;                ///< at most; the second is used where it pays (n > 150 or so)
  bool record_jacobians = false;  ///< H of each observation in snapshots of updates (2×N each)
};

/// What happened since construction, in observations except where said.
struct EkfCounters {
  std::uint64_t predictions = 0;  ///< predictions
  std::uint64_t updates = 0;      ///< updates of the state (one a batch)
  std::uint64_t observed = 0;     ///< used in updates
  std::uint64_t gated_out = 0;    ///< outside the gate
  std::uint64_t degenerate = 0;   ///< left out: expected reading undefined, or S not invertible
  std::uint64_t initialised = 0;
  std::uint64_t removed = 0;  ///< features
};

/// EKF-SLAM on two-dimensional point features (section 2.1 of the paper), a Subject that publishes
/// a snapshot of each event kind that somebody subscribed to. The equations are in `EkfEquations`;
/// here is the order of events. `sequence` counts events whether anybody listens or not.
///
/// One time step: `step(time, motion, observations)`; or `predict` as often as odometry comes and
/// `observe` when readings come, which closes the step with event `step`. `update`, `initialise`
/// and `remove` are there for callers with an association or map policy of their own.
///
/// Times must not go back and numbers must be finite, else std::invalid_argument.
class EkfSlam : public Subject {
 public:
  using Subject::observe;  // how others listen; below, `observe` is how the filter senses

  explicit EkfSlam(const EkfOptions& options);
  /// With other equations (a planted fault); their sensor must be the options' sensor.
  EkfSlam(const EkfOptions& options, std::unique_ptr<EkfEquations> equations);

  /// Publishes event `initial`: call it once, when observers are attached.
  void start(std::chrono::nanoseconds time);

  /// (3), (4). Event `predict` with control and Q.
  void predict(std::chrono::nanoseconds time, const Motion& motion);

  /// (5)–(11) with observations of features in the map (else std::invalid_argument), at the current
  /// time. Event `update`: one for the batch, or one for each observation when sequential. Returns
  /// the ids that were used (gate passed), valid until the next call.
  const std::vector<FeatureId>& update(std::span<const Observation> observations);

  /// Appends a feature that is not in the map yet (else std::invalid_argument). Event `initialise`.
  void initialise(const Observation& observation);

  /// Takes a feature of the map out of the state (std::invalid_argument if unknown). Event
  /// `remove`.
  void remove(FeatureId id);

  /// Readings of one time with known association: updates with those of known features, then
  /// initialises the new ones. Event `step` closes it, also where `observations` is empty.
  void observe(std::chrono::nanoseconds time, std::span<const Observation> observations);

  /// predict, then observe.
  void step(std::chrono::nanoseconds time, const Motion& motion,
            std::span<const Observation> observations);

  /// The truth put into every snapshot from now on, where known (simulation, motion capture).
  void setTruth(std::optional<Truth> truth) { truth_ = std::move(truth); }

  /// The features that every snapshot from now on calls tentative, where they are in the map.
  void setTentative(std::vector<FeatureId> ids) { tentative_ = std::move(ids); }

  [[nodiscard]] const EkfState& state() const { return state_; }
  [[nodiscard]] const EkfOptions& options() const { return options_; }
  [[nodiscard]] const EkfCounters& counters() const { return counters_; }
  /// Features whose readings the gate left out since the last prediction or `observe` began.
  [[nodiscard]] const std::vector<FeatureId>& rejected() const { return rejected_; }
  [[nodiscard]] std::chrono::nanoseconds time() const {
    return time_.value_or(std::chrono::nanoseconds{});
  }
  [[nodiscard]] bool knows(FeatureId id) const { return state_.rowOf(id).has_value(); }
  /// The current posterior as a snapshot, without an event of its own (event `step`).
  [[nodiscard]] Snapshot snapshot() const { return makeSnapshot(Event::step); }

 private:
  void advance(std::chrono::nanoseconds time);
  bool passes(const Observation& observation);
  /// Takes out, and counts, readings that have no Jacobian here; whether some went and some are
  /// left.
  bool dropUndefined(std::vector<Observation>& observations);
  void updateOnce(std::span<const Observation> observations);
  [[nodiscard]] Snapshot makeSnapshot(Event event) const;
  template <typename Fill>
  void announce(Event event, Fill fill);

  EkfOptions options_;
  std::unique_ptr<EkfEquations> equations_;
  EkfState state_;
  EkfCounters counters_;
  std::optional<Truth> truth_;
  std::vector<FeatureId> tentative_;
  std::vector<FeatureId> rejected_;
  // Memory of a step, kept for the next: a steady filter to which nobody listens allocates nothing.
  std::vector<Observation> known_;
  std::vector<Observation> fresh_;
  std::vector<Observation> accepted_;
  std::vector<FeatureId> used_;
  std::vector<FeatureId> observed_;
  std::optional<std::chrono::nanoseconds> time_;
  std::uint64_t sequence_ = 0;
};

}  // namespace slamscope::slam
