// SPDX-License-Identifier: MIT
#include "apps/lib/view/head_view.hpp"

#include <algorithm>
#include <cstdio>
#include <future>
#include <span>

namespace slamscope::apps {
namespace {

using tracking::HeadPicture, tracking::TagDetection;

tracking::TagSearch::Place placeOf(const TagDetection& tag) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : tag.corners_px) centre += 0.25 * corner;
  double half = 0.0;
  for (const Eigen::Vector2d& corner : tag.corners_px) {
    half = std::max(half, (corner - centre).lpNorm<Eigen::Infinity>());
  }
  return {centre, half};
}

}  // namespace

HeadView::HeadView(const StereoSetup& setup, int pairs)
    : setup_(setup), rig_(drawnRig(setup.rig)), tracker_(setup.rig, setup.tags) {
  for (std::size_t eye = 0; eye < rig_.cameras.size(); ++eye) cameras_.emplace_back(rig_, eye);
  for (std::size_t eye = 0; eye < setup.source->cameras(); ++eye) {
    searches_.emplace_back(cameras_[eye], setup.tags);
  }
  if (setup.robot) {
    robot_.emplace(setup.rig, *setup.robot, pairs * static_cast<int>(searches_.size()));
  } else {
    origin_.emplace();
  }
}

std::chrono::nanoseconds HeadView::midExposure(std::size_t eye,
                                               const tracking::Frame& frame) const {
  return frame.time + rig_.cameras[eye].time_offset;
}

std::vector<TagDetection> HeadView::find(std::size_t eye, const tracking::Frame& frame) {
  std::optional<tracking::HeadMotion> motion;
  if (const auto pose = tracker_.at(midExposure(eye, frame))) motion = pose->motion;
  const bool robot_sought = robot_ && !robot_->place() && robot_seen_[eye].empty();
  return searches_[eye].find(frame, motion, robot_seen_[eye], robot_sought);
}

void HeadView::add(const tracking::StereoFrame& frame) {
  std::array<std::future<std::vector<TagDetection>>, 2> found;
  for (std::size_t eye = 0; eye < searches_.size(); ++eye) {
    if (!frame.eyes[eye]) continue;
    found[eye] = std::async(std::launch::async,
                            [this, eye, &one = *frame.eyes[eye]] { return find(eye, one); });
  }
  std::vector<HeadPicture> pictures;
  for (std::size_t eye = 0; eye < searches_.size(); ++eye) {
    if (found[eye].valid()) {
      pictures.push_back({eye, frame.eyes[eye]->time, found[eye].get()});
    }
  }
  tracker_.add(pictures);
  for (std::size_t eye = 0; eye < eyes_.size(); ++eye) {
    eyes_[eye].picture = eye < searches_.size() && frame.eyes[eye].has_value();
    const std::size_t timed = eyes_[eye].picture ? eye : 1 - eye;
    eyes_[eye].time = midExposure(timed, *frame.eyes[timed]);
    eyes_[eye].head = tracker_.at(eyes_[eye].time);
  }
  addRobot(pictures);
  look(0);
  look(1);
}

void HeadView::addRobot(std::span<const HeadPicture> pictures) {
  if (!robot_) return;
  for (const HeadPicture& picture : pictures) {
    auto& seen = robot_seen_[picture.camera];
    seen.clear();
    if (robot_->place()) continue;
    for (const TagDetection& tag : picture.tags) {
      if (tag.id == setup_.robot->id) seen.push_back(placeOf(tag));
    }
    const auto& head = eyes_[picture.camera].head;
    if (head) robot_->add(*head, picture);
  }
}

void HeadView::look(std::size_t eye) {
  EyeSight& sight = eyes_[eye];
  const Eigen::Isometry3d T_head_camera = rig_.T_head_camera(eye);
  sight.T_eye_map.reset();
  sight.own_error = {};
  if (sight.head && place()) {
    sight.T_eye_map =
        (sight.head->motion.T_world_head * T_head_camera).inverse() * place()->T_world_map;
    sight.own_error = tracking::overlayError(cameras_[eye], sight.head->motion, *place());
  }
  if (setup_.lab == nullptr) return;
  const tracking::Rig& truth = setup_.lab->options().rig;
  sight.true_T_world_head = setup_.lab->T_world_head(sight.time);
  sight.true_T_eye_map = (*sight.true_T_world_head * truth.T_head_camera(eye)).inverse() *
                         setup_.lab->options().room.T_world_map;
}

std::chrono::nanoseconds HeadView::time() const {
  return std::min(eyes_[0].time, eyes_[1].time);
}

tracking::HeadState HeadView::state() const {
  return tracker_.state(std::max(eyes_[0].time, eyes_[1].time));
}

const std::optional<tracking::MapPlace>& HeadView::place() const {
  return robot_ ? robot_->place() : origin_;
}

std::optional<Eigen::Matrix2d> HeadView::ownErrorOnFloor(const Eigen::Vector3d& p_map) const {
  if (!eyes_[0].head || !place()) return std::nullopt;
  return tracking::overlayCovarianceOnFloor(cameras_[0], eyes_[0].head->motion, *place(), p_map);
}

std::vector<std::string> HeadView::statusLines() const {
  std::vector<std::string> lines;
  lines.push_back((setup_.calibrated() ? "" : "uncalibrated · ") +
                  tracker_.status(std::max(eyes_[0].time, eyes_[1].time)));
  if (robot_) lines.push_back(robot_->status());
  const tracking::OverlayError& error = eyes_[0].own_error;
  if (error.px > 0.0) {
    char own[96];
    std::snprintf(own, sizeof own, "overlay by tracker and registration alone: ±%.2f px ±%.1f mm",
                  error.px, 1e3 * error.floor_m);
    lines.emplace_back(own);
  }
  return lines;
}

std::vector<std::string> HeadView::problems() const {
  std::vector<std::string> all = tracker_.problems();
  for (std::size_t eye = 0; eye < searches_.size(); ++eye) {
    const std::string problem = searches_[eye].problem();
    if (!problem.empty()) all.push_back((eye == 0 ? "left camera: " : "right camera: ") + problem);
  }
  if (robot_) all.insert(all.end(), robot_->problems().begin(), robot_->problems().end());
  return all;
}

}  // namespace slamscope::apps
