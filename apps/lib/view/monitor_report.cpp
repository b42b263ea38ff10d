// SPDX-License-Identifier: MIT
#include "apps/lib/view/monitor_report.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace slamscope::apps {
namespace {

using nlohmann::ordered_json;

template <typename Matrix>
ordered_json rows(const Matrix& matrix) {
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

ordered_json registrationJson(const FrameReport& frame) {
  ordered_json json{{"state", tracking::name(frame.state)}};
  const auto& result = frame.registration;
  json["mode"] = result ? ordered_json(tracking::name(result->mode)) : ordered_json(nullptr);
  json["T_camera_map"] = result ? rows(result->T_camera_map.matrix()) : ordered_json(nullptr);
  json["covariance"] = result ? rows(result->covariance) : ordered_json(nullptr);
  json["residual_px"] = result ? ordered_json(result->residual_px) : ordered_json(nullptr);
  json["predicted_overlay_error_px"] =
      result ? ordered_json(result->overlay_error_px) : ordered_json(nullptr);
  return json;
}

}  // namespace

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
  frames_.push_back({{"time_s", frame.time_s},
                     {"snapshot_time_s", orNull(frame.snapshot_time_s)},
                     {"registration", registrationJson(frame)},
                     {"overlay_error_px", orNull(worst)},
                     {"slam_error_m", orNull(frame.slam_error_m)},
                     {"drawn", {{"ellipsoids", frame.ellipsoids}, {"features", frame.features}}},
                     {"tips_px", std::move(tips)}});
  overlay_errors_px_.insert(overlay_errors_px_.end(), frame.overlay_errors_px.begin(),
                            frame.overlay_errors_px.end());
}

void MonitorReport::addStage(const std::string& stage, double milliseconds) {
  stage_ms_[stage].push_back(milliseconds);
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
          {"stage_ms", std::move(stages)}};
}

void MonitorReport::write(const std::filesystem::path& file) const {
  const ordered_json report{{"frames", frames_}, {"summary", summary()}};
  const std::filesystem::path partial = file.string() + ".partial";
  std::ofstream out(partial);
  out << report.dump(1) << '\n';
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": can't be written");
  std::filesystem::rename(partial, file);
}

}  // namespace slamscope::apps
