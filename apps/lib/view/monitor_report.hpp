// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/lib/audit_watch.hpp"
#include "slam/snapshot.hpp"
#include "tracking/registration.hpp"

namespace slamscope::apps {

/// A cone's tip in the drawn picture, OpenCV's convention.
struct TipPixel {
  slam::FeatureId id = 0;
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
};

/// What `monitor --report` says of one drawn frame.
struct FrameReport {
  double time_s = 0.0;
  std::optional<double> snapshot_time_s;
  tracking::RegistrationState state = tracking::RegistrationState::searching;
  std::optional<tracking::RegistrationResult> registration;
  /// Of each feature drawn: distance (px) between where the overlay puts the estimate and where the
  /// true camera and the true T_camera_map put the same estimate. Empty without truth.
  std::vector<double> overlay_errors_px;
  std::optional<double> slam_error_m;  ///< RMS distance of estimates from true features
  std::size_t ellipsoids = 0, features = 0;
  std::vector<TipPixel> tips;
  std::optional<Judgement> judgement;  ///< absent where there is no audit
};

/// Gathers the frames and writes the report. In the file a frame's overlay_error_px is its largest;
/// the summary's median and p95 are over all features of all frames.
class MonitorReport {
 public:
  void add(const FrameReport& frame);
  /// A frame of another viewer, as it stands in the file, with the errors that the summary counts.
  void addFrame(nlohmann::ordered_json frame, const std::vector<double>& overlay_errors_px);
  void addStage(const std::string& stage, double milliseconds);
  /// Of the device, after a frame. The host's is asked for when the report is made.
  void addDeviceMemory(std::size_t bytes);
  /// Throws std::runtime_error where the file can't be written.
  void write(const std::filesystem::path& file) const;

  [[nodiscard]] nlohmann::ordered_json summary() const;

 private:
  nlohmann::ordered_json frames_ = nlohmann::ordered_json::array();
  std::vector<double> overlay_errors_px_;
  std::map<std::string, std::vector<double>> stage_ms_;
  std::size_t device_bytes_ = 0;  ///< at most
};

[[nodiscard]] nlohmann::ordered_json rowsJson(const Eigen::MatrixXd& matrix);
[[nodiscard]] nlohmann::ordered_json orNull(const std::optional<double>& value);
/// What the audit says, null where there is none.
[[nodiscard]] nlohmann::ordered_json alarmsJson(const std::optional<Judgement>& judgement);

/// The share-quantile (0 … 1) of values by linear interpolation; nothing of none.
[[nodiscard]] std::optional<double> quantile(std::vector<double> values, double share);

}  // namespace slamscope::apps
