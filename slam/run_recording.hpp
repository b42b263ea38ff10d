// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>

#include "slam/ekf_slam.hpp"
#include "slam/recording.hpp"

namespace slamscope::slam {

/// Noise and gates of a filter on recorded data. The defaults suit slow indoor robots with wheel
/// odometry and a camera (MR.CLAM). Too tight noise makes a filter sure of a wrong map; start wide.
struct RecordingRunOptions {
  /// σ of a sighting: range (m), bearing (rad); where the recording gives σ, those are used.
  Eigen::Vector2d sensor_sigma{0.30, 0.05};
  /// σ of dead reckoning after 1 s of driving: forward (m), sideways (m), turn (rad). Grows with
  /// the root of time, so that the rate of the odometry does not matter. None while it says
  /// standstill.
  Eigen::Vector3d odometry_sigma{0.015, 0.005, 0.05};
  Eigen::Vector3d initial_sigma = Eigen::Vector3d::Zero();  ///< x, y (m), θ (rad)
  UpdateMode update = UpdateMode::batch;
  /// Sightings outside the χ² ellipse of this probability are left out and counted. Real sensors
  /// misread a barcode now and then (MR.CLAM robots 3 and 5: 4 and 5 times), and one is enough to
  /// bend a map; a gate much tighter rejects good sightings once the filter is a little too sure.
  std::optional<double> gate_probability = 0.9999;
  bool record_jacobians = false;
  /// Where nothing is seen for longer, predictions come at least so often.
  std::chrono::nanoseconds longest_prediction = std::chrono::seconds(1);
};

/// Drives an EKF-SLAM filter over a recording with known association, one time step a call, so that
/// it can be watched while it runs. The map's origin is the robot's pose at the recording's start.
///
///   RecordingRun run(readMrclam(folder, 1), {});
///   Recorder recorder(run.filter(), "run.jsonl", run.header());
///   while (run.step()) {}
///   recorder.finish();
class RecordingRun {
 public:
  RecordingRun(Recording recording, const RecordingRunOptions& options);

  /// The Subject to observe; attach before the first step().
  [[nodiscard]] EkfSlam& filter() { return filter_; }
  [[nodiscard]] const EkfSlam& filter() const { return filter_; }

  /// The first call publishes `initial`; each later one goes on to the next sightings (event `step`
  /// closes them) or, where there are none for long, predicts only. False, and nothing done, at the
  /// end of the recording. With a true path, snapshots carry the truth; the true pose is NaN where
  /// the path has none.
  bool step();

  [[nodiscard]] double progress() const;  ///< 0 … 1
  [[nodiscard]] RunHeader header() const;
  [[nodiscard]] const Recording& recording() const { return recording_; }

 private:
  void predictTo(std::chrono::nanoseconds time);
  [[nodiscard]] Motion motionBetween(std::chrono::nanoseconds from, std::chrono::nanoseconds to);
  [[nodiscard]] Eigen::Vector3d entryMotion(std::size_t entry, std::chrono::nanoseconds from,
                                            std::chrono::nanoseconds to) const;
  [[nodiscard]] std::vector<Observation> observationsOf(const Sightings& sightings) const;
  void publishTruth(std::chrono::nanoseconds time);

  Recording recording_;
  RecordingRunOptions options_;
  EkfSlam filter_;
  bool started_ = false;
  std::size_t next_entry_ = 0;
  std::size_t next_sighting_ = 0;
};

}  // namespace slamscope::slam
