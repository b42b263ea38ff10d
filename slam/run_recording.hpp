// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slam/dead_reckoning.hpp"
#include "slam/ekf_slam.hpp"
#include "slam/hypothesis_search.hpp"
#include "slam/labelled_recording.hpp"
#include "slam/laser_front_end.hpp"
#include "slam/map_builder.hpp"
#include "slam/recording.hpp"
#include "slam/view_limits.hpp"

namespace slamscope::slam {

/// Noise, gates and association of a filter on recorded data. The defaults suit slow indoor robots
/// with wheel odometry and a camera (MR.CLAM). Too tight noise makes a filter sure of a wrong map;
/// start wide.
struct RecordingRunOptions {
  /// σ of a sighting, range (m) and bearing (rad), or x and y (m); where the recording gives a
  /// covariance, that is used.
  Eigen::Vector2d sensor_sigma{0.30, 0.05};
  /// See DeadReckoning.
  Eigen::Vector3d odometry_sigma{0.015, 0.005, 0.05};
  Eigen::Vector3d initial_sigma = Eigen::Vector3d::Zero();  ///< x, y (m), θ (rad)
  UpdateMode update = UpdateMode::batch;
  bool first_estimates = false;  ///< linearised as FirstEstimates says
  /// With known ids: sightings outside the χ² ellipse of this probability are left out and counted.
  /// Real sensors misread a barcode now and then (MR.CLAM robots 3 and 5: 4 and 5 times), and one
  /// is enough to bend a map; a gate much tighter rejects good sightings once the filter is a
  /// little too sure.
  std::optional<double> gate_probability = 0.9999;
  Association association = Association::known;
  AssociationGates gates{};   ///< of `nearest` and `joint`
  FeatureLifeOptions life{};  ///< of `nearest` and `joint`
  /// With `joint`: where hypotheses are asked for, the recording is gone through before the run,
  /// and the run takes the best one's labels as ids. `gates`, `life` and `view` have no say then.
  HypothesisOptions hypotheses{};
  std::optional<ViewLimits> view{};  ///< where absent, sightings that do not come are not missed
  LaserPointOptions laser{};         ///< where the recording has scans
  bool record_jacobians = false;
  /// Where nothing is seen for longer, predictions come at least so often.
  std::chrono::nanoseconds longest_prediction = std::chrono::seconds(1);
};

/// Drives an EKF-SLAM filter over a recording, one time step a call, so that it can be watched
/// while it runs. The map's origin is the robot's pose at the recording's start.
///
///   RecordingRun run(readMrclam(folder, 1), {});
///   Recorder recorder(run.filter(), "run.jsonl", run.header());
///   while (run.step()) {}
///   recorder.finish();
class RecordingRun {
 public:
  /// Throws std::invalid_argument for options out of range, and for known association where the
  /// recording knows no ids. Hypotheses are searched here, which takes as long as a run or longer.
  RecordingRun(Recording recording, const RecordingRunOptions& options);
  RecordingRun(const RecordingRun&) = delete;
  RecordingRun& operator=(const RecordingRun&) = delete;

  /// The Subject to observe; attach before the first step().
  [[nodiscard]] EkfSlam& filter() { return filter_; }
  [[nodiscard]] const EkfSlam& filter() const { return filter_; }

  /// The first call publishes `initial`; each later one goes on to the next sightings or scan
  /// (event `step` closes them) or, where there are none for long, predicts only. False, and
  /// nothing done, at the end of the recording. With a true path, snapshots carry the truth; the
  /// true pose is NaN where the path has none. With known association that includes the true
  /// features.
  bool step();

  /// To which time the next step() goes; absent at the end.
  [[nodiscard]] std::optional<std::chrono::nanoseconds> nextTime() const;
  [[nodiscard]] double progress() const;  ///< 0 … 1
  [[nodiscard]] RunHeader header() const;
  [[nodiscard]] const Recording& recording() const { return recording_; }
  /// What became of readings without ids; nothing with known association.
  [[nodiscard]] std::optional<MapCounters> mapCounters() const;
  /// Readings that were paired with a feature of which most readings carry another id: what the
  /// association got wrong, where ids are known and were only hidden from it.
  [[nodiscard]] std::uint64_t mispaired() const;
  /// Feature → id of the recording, for confirmed features where ids are hidden from the filter.
  [[nodiscard]] std::map<FeatureId, FeatureId> hiddenNames() const;
  /// What people should know of the run so far, one line each: ids that seem to be used for another
  /// place, readings that were left out.
  [[nodiscard]] std::vector<std::string> remarks() const;

 private:
  void predictTo(std::chrono::nanoseconds time);
  void sense(std::size_t index);
  [[nodiscard]] bool idsHidden() const { return map_ || labels_; }
  [[nodiscard]] std::vector<Observation> observationsOf(const Sightings& sightings) const;
  [[nodiscard]] MapBuilder::View limitedView() const;
  void watchIds(const Sightings& sightings);
  void publishTruth(std::chrono::nanoseconds time);

  Recording recording_;
  RecordingRunOptions options_;
  std::optional<LabelledReadings> labels_;  ///< by hypotheses; the recording has them
  EkfSlam filter_;
  DeadReckoning dead_reckoning_;
  std::optional<LaserFrontEnd> front_end_;
  std::optional<MapBuilder> map_;
  std::map<FeatureId, int> rejected_in_a_row_;
  std::map<FeatureId, int> most_rejected_;  ///< of features that were rejected suspiciously often
  bool started_ = false;
  std::size_t next_ = 0;
};

}  // namespace slamscope::slam
