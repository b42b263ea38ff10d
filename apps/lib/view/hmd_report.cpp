// SPDX-License-Identifier: MIT
#include "apps/lib/view/hmd_report.hpp"

#include <cmath>
#include <numbers>

namespace slamscope::apps {
namespace {

using Eigen::Isometry3d;
using nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;

ordered_json poseJson(const std::optional<Isometry3d>& T) {
  return T ? rowsJson(T->matrix()) : ordered_json(nullptr);
}

/// Distance (m) and angle (degrees) of a pose from the true one.
void addPoseError(ordered_json& json, const std::optional<Isometry3d>& T,
                  const std::optional<Isometry3d>& truth) {
  std::optional<double> metres, degrees;
  if (T && truth) {
    metres = (T->translation() - truth->translation()).norm();
    degrees = kDegrees * Eigen::AngleAxisd(truth->linear().transpose() * T->linear()).angle();
  }
  json["position_error_m"] = orNull(metres);
  json["rotation_error_deg"] = orNull(degrees);
}

ordered_json headJson(const HeadView& head) {
  const tracking::HeadFix& fix = head.tracker().last();
  return {{"state", tracking::name(head.state())},
          {"calibrated", head.rig().calibrated},
          {"tags_seen", fix.tags_seen},
          {"tags_used", fix.tags_used},
          {"corners_used", fix.corners_used},
          {"residual_px", fix.residual_px},
          {"rejected_ids", fix.rejected_ids},
          {"surprise", orNull(fix.surprise)},
          {"relocked", fix.relocked}};
}

ordered_json robotJson(const HmdFrame& frame) {
  const auto& place = frame.head.place();
  ordered_json json{{"registered", place.has_value()}, {"pictures", frame.head.robotPictures()}};
  std::optional<Isometry3d> T_world_map;
  if (place) T_world_map = place->T_world_map;
  json["T_world_map"] = poseJson(T_world_map);
  json["covariance"] = place ? rowsJson(place->covariance) : ordered_json(nullptr);
  addPoseError(json, T_world_map, frame.true_T_world_map);
  return json;
}

ordered_json eyeJson(const EyeSight& sight, const FrameReport& drawn) {
  ordered_json json{{"picture", sight.picture},
                    {"mid_exposure_s", std::chrono::duration<double>(sight.time).count()}};
  json["state"] = sight.head ? ordered_json(tracking::name(sight.head->state)) : nullptr;
  std::optional<Isometry3d> T_world_head;
  if (sight.head) T_world_head = sight.head->motion.T_world_head;
  json["T_world_head"] = poseJson(T_world_head);
  json["head_covariance"] = sight.head
                                ? rowsJson(sight.head->motion.covariance.topLeftCorner<6, 6>())
                                : ordered_json(nullptr);
  json["T_eye_map"] = poseJson(sight.T_eye_map);
  addPoseError(json, T_world_head, sight.true_T_world_head);
  json["predicted_overlay_error_px"] =
      sight.T_eye_map ? ordered_json(sight.own_error.px) : ordered_json(nullptr);
  json["overlay_error_px"] = orNull(quantile(drawn.overlay_errors_px, 1.0));
  ordered_json tips = ordered_json::array();
  for (const TipPixel& tip : drawn.tips) tips.push_back({tip.id, tip.px.x(), tip.px.y()});
  json["tips_px"] = std::move(tips);
  return json;
}

}  // namespace

ordered_json hmdFrameJson(const HmdFrame& frame) {
  const FrameReport& left = frame.eyes[0];
  return {{"time_s", left.time_s},
          {"snapshot_time_s", orNull(left.snapshot_time_s)},
          {"head", headJson(frame.head)},
          {"robot", robotJson(frame)},
          {"left", eyeJson(frame.head.eyes()[0], left)},
          {"right", eyeJson(frame.head.eyes()[1], frame.eyes[1])},
          {"slam_error_m", orNull(left.slam_error_m)},
          {"drawn", {{"ellipsoids", left.ellipsoids}, {"features", left.features}}},
          {"problems", frame.problems},
          {"alarms", alarmsJson(left.judgement)}};
}

}  // namespace slamscope::apps
