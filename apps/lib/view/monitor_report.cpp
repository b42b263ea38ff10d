// SPDX-License-Identifier: MIT
#include "apps/lib/view/monitor_report.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "apps/lib/whole_file.hpp"

namespace slamscope::apps {
namespace {

using nlohmann::ordered_json;

ordered_json registrationJson(const FrameReport& frame) {
  ordered_json json{{"state", tracking::name(frame.state)}};
  const auto& result = frame.registration;
  json["mode"] = result ? ordered_json(tracking::name(result->mode)) : ordered_json(nullptr);
  json["T_camera_map"] = result ? rowsJson(result->T_camera_map.matrix()) : ordered_json(nullptr);
  json["covariance"] = result ? rowsJson(result->covariance) : ordered_json(nullptr);
  json["residual_px"] = result ? ordered_json(result->residual_px) : ordered_json(nullptr);
  json["predicted_overlay_error_px"] =
      result ? ordered_json(result->overlay_error_px) : ordered_json(nullptr);
  return json;
}

ordered_json brokenJson(const slam::LawReport& law) {
  ordered_json features = ordered_json::array();
  for (const slam::Blame& blame : law.blame) features.push_back(blame.feature);
  return {{"law", slam::lawName(law.law)},
          {"class", slam::faultClassName(*law.fault_class)},
          {"first_record", law.first_record.value_or(0)},
          {"first_time_s", law.first_time_s.value_or(0.0)},
          {"violations", law.violations},
          {"amount", law.amount},
          {"features", std::move(features)}};
}

/// The most memory that this process ever had.
std::uint64_t hostPeakBytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t{1024} * static_cast<std::uint64_t>(usage.ru_maxrss);  // Linux counts KiB
}

}  // namespace

ordered_json rowsJson(const Eigen::MatrixXd& matrix) {
  ordered_json all = ordered_json::array();
  for (int row = 0; row < matrix.rows(); ++row) {
    ordered_json one = ordered_json::array();
    for (int col = 0; col < matrix.cols(); ++col) one.push_back(matrix(row, col));
    all.push_back(std::move(one));
  }
  return all;
}

ordered_json orNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json alarmsJson(const std::optional<Judgement>& judgement) {
  if (!judgement) return nullptr;
  ordered_json broken = ordered_json::array();
  for (const slam::LawReport& law : judgement->broken) broken.push_back(brokenJson(law));
  ordered_json first = ordered_json::array();
  for (const slam::FeatureAlarm& alarm : judgement->alarms.features) {
    first.push_back({{"feature", alarm.feature},
                     {"law", slam::lawName(alarm.law)},
                     {"record", alarm.first_record},
                     {"active", alarm.active}});
  }
  return {{"records", judgement->records},
          {"record", judgement->record},
          {"time_s", std::chrono::duration<double>(judgement->time).count()},
          {"broken", std::move(broken)},
          {"flagged", judgement->flagged()},
          {"flagged_pairs", judgement->alarms.pairs.size()},
          {"blamed", std::move(first)}};
}

std::optional<double> quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - std::floor(place));
}

void MonitorReport::add(const FrameReport& frame) {
  ordered_json tips = ordered_json::array();
  for (const TipPixel& tip : frame.tips) tips.push_back({tip.id, tip.px.x(), tip.px.y()});
  const auto worst = quantile(frame.overlay_errors_px, 1.0);
  addFrame({{"time_s", frame.time_s},
            {"snapshot_time_s", orNull(frame.snapshot_time_s)},
            {"registration", registrationJson(frame)},
            {"overlay_error_px", orNull(worst)},
            {"slam_error_m", orNull(frame.slam_error_m)},
            {"drawn", {{"ellipsoids", frame.ellipsoids}, {"features", frame.features}}},
            {"tips_px", std::move(tips)},
            {"alarms", alarmsJson(frame.judgement)}},
           frame.overlay_errors_px);
}

void MonitorReport::addFrame(ordered_json frame, const std::vector<double>& overlay_errors_px) {
  frames_.push_back(std::move(frame));
  overlay_errors_px_.insert(overlay_errors_px_.end(), overlay_errors_px.begin(),
                            overlay_errors_px.end());
}

void MonitorReport::addStage(const std::string& stage, double milliseconds) {
  stage_ms_[stage].push_back(milliseconds);
}

void MonitorReport::addDeviceMemory(std::size_t bytes) {
  device_bytes_ = std::max(device_bytes_, bytes);
}

ordered_json MonitorReport::summary() const {
  ordered_json stages = ordered_json::object();
  for (const auto& [name, times] : stage_ms_) {
    stages[name] = {{"median", orNull(quantile(times, 0.5))},
                    {"p95", orNull(quantile(times, 0.95))}};
  }
  return {{"overlay_error_px",
           {{"median", orNull(quantile(overlay_errors_px_, 0.5))},
            {"p95", orNull(quantile(overlay_errors_px_, 0.95))},
            {"max", orNull(quantile(overlay_errors_px_, 1.0))}}},
          {"stage_ms", std::move(stages)},
          {"memory", {{"device_bytes", device_bytes_}, {"host_peak_bytes", hostPeakBytes()}}}};
}

void MonitorReport::write(const std::filesystem::path& file) const {
  const ordered_json report{{"frames", frames_}, {"summary", summary()}};
  writeWhole(file, report.dump(1) + '\n');
}

}  // namespace slamscope::apps
