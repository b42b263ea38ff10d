// SPDX-License-Identifier: MIT
#include "tracking/room_start.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/tag_pose.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d;

constexpr std::size_t kMostCandidates = 24;

const TagDetection* detectionOf(const RoomPicture& picture, int id) {
  for (const TagDetection& tag : picture.tags) {
    if (tag.id == id) return &tag;
  }
  return nullptr;
}

/// One growing room.
class RoomGrower {
 public:
  RoomGrower(std::span<const CameraModel> cameras, std::span<const RoomPicture> pictures,
             const MappedTag& gauge, const std::string& family)
      : cameras_(cameras), pictures_(pictures) {
    start_.layout = {family, {gauge}};
    start_.T_camera_world.resize(pictures.size());
  }

  /// Poses of the pictures that see known tags; a lone tag that could be seen either way doesn't
  /// count while there are others.
  void locatePictures() {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      const auto pose =
          estimateTagPose(cameras_[pictures_[i].camera], start_.layout, pictures_[i].tags);
      if (pose && !pose->ambiguous) start_.T_camera_world[i] = pose->T_camera_world;
    }
  }

  /// The unknown tag that most located pictures see, placed. False when there is none.
  bool placeNext(std::vector<MappedTag>& waiting) {
    const auto seen = [&](const MappedTag& tag) {
      std::size_t count = 0;
      for (std::size_t i = 0; i < pictures_.size(); ++i) {
        if (start_.T_camera_world[i] && detectionOf(pictures_[i], tag.id)) ++count;
      }
      return count;
    };
    const auto next = std::max_element(waiting.begin(), waiting.end(),
                                       [&](auto& a, auto& b) { return seen(a) < seen(b); });
    if (next == waiting.end() || seen(*next) == 0) return false;
    MappedTag tag = *next;
    waiting.erase(next);
    if (const auto T = bestPlace(tag)) {
      tag.T_world_tag = *T;
      start_.layout.tags.push_back(tag);
    }
    return true;
  }

  [[nodiscard]] RoomStart start() const { return start_; }

 private:
  /// Both planar poses by every picture that sees it; the one that fits all of these best.
  [[nodiscard]] std::optional<Isometry3d> bestPlace(const MappedTag& tag) const {
    const TagLayout alone{start_.layout.family, {{tag.id, tag.size_m, Isometry3d::Identity()}}};
    std::vector<Isometry3d> candidates;
    for (std::size_t i = 0; i < pictures_.size() && candidates.size() < kMostCandidates; ++i) {
      const TagDetection* seen = detectionOf(pictures_[i], tag.id);
      if (!start_.T_camera_world[i] || !seen) continue;
      const auto pose = estimateTagPose(cameras_[pictures_[i].camera], alone, std::span(seen, 1));
      if (!pose) continue;
      const Isometry3d T_world_camera = start_.T_camera_world[i]->inverse();
      candidates.push_back(T_world_camera * pose->T_camera_world);
      if (pose->other) candidates.push_back(T_world_camera * *pose->other);
    }
    std::optional<Isometry3d> best;
    double least = 0;
    for (const Isometry3d& T : candidates) {
      const double sum = misfitOf(tag, T);
      if (best && sum >= least) continue;
      best = T;
      least = sum;
    }
    return best;
  }

  [[nodiscard]] double misfitOf(const MappedTag& tag, const Isometry3d& T_world_tag) const {
    const auto p_tag = tagCorners(tag.size_m);
    double sum = 0;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      const TagDetection* seen = detectionOf(pictures_[i], tag.id);
      if (!start_.T_camera_world[i] || !seen) continue;
      for (std::size_t c = 0; c < 4; ++c) {
        const auto px = cameras_[pictures_[i].camera].project(*start_.T_camera_world[i] *
                                                              (T_world_tag * p_tag[c]));
        const double distance = px ? (*px - seen->corners_px[c]).norm() : 1e3;
        sum += std::log1p(distance * distance);
      }
    }
    return sum;
  }

  std::span<const CameraModel> cameras_;
  std::span<const RoomPicture> pictures_;
  RoomStart start_;
};

}  // namespace

RoomStart startRoom(std::span<const CameraModel> cameras, std::span<const RoomPicture> pictures,
                    const MappedTag& gauge, const std::vector<MappedTag>& sizes,
                    const std::string& family) {
  RoomGrower grower(cameras, pictures, gauge, family);
  std::vector<MappedTag> waiting;
  for (const MappedTag& tag : sizes) {
    if (tag.id != gauge.id) waiting.push_back(tag);
  }
  do {
    grower.locatePictures();
  } while (grower.placeNext(waiting));
  return grower.start();
}

}  // namespace slamscope::tracking
