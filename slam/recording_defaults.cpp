// SPDX-License-Identifier: MIT
#include "slam/recording_defaults.hpp"
namespace slamscope::slam {

RecordingRunOptions usualOptions(const Recording& recording, Association association,
                                 int hypotheses) {
  RecordingRunOptions options;
  options.association = association;
  options.hypotheses.most = hypotheses;
  options.life.separation = recording.separation;
  if (recording.odometry.empty()) {
    options.odometry_sigma = {0.3, 0.3, 0.3};
  } else if (recording.odometry_kind == Recording::Odometry::ackermann) {
    options.odometry_sigma = {0.1, 0.05, 0.05};
  }
  if (options.odometry_sigma != RecordingRunOptions().odometry_sigma) {
    options.hypotheses.odometry_sigma = options.odometry_sigma;
    options.hypotheses.turn_sigma = 0.0;  // that is how wheels of slow robots err
  }
  if (association == Association::known || hypotheses > 0 || !recording.scans.empty()) {
    return options;
  }
  options.sensor_sigma = {0.35, 0.06};
  options.gates.pair = 0.9999;
  options.gates.fresh = 0.999999;
  options.life.confirm_after = 4;
  options.life.drop_after = 6;
  options.life.longest_doubt = std::chrono::nanoseconds(0);
  options.view = {4.0, 0.35};
  return options;
}

}  // namespace slamscope::slam
