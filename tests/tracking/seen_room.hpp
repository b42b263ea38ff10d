// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <set>

#include "tracking/head_path.hpp"
#include "tracking/head_tracker.hpp"
#include "tracking/lab_lens.hpp"
#include "tracking/stereo_lab.hpp"

namespace slamscope::tracking::testing {

/// The lab's rig with f = 900 px at 1280 × 960: the spec's figures are in its pixels.
inline Rig fineRig() {
  Rig rig = defaultLabRig(2);
  for (RigCamera& camera : rig.cameras) camera.info.K(0, 0) = camera.info.K(1, 1) = 900;
  return rig;
}

/// A room of tags, a head that moves in it, and what a detector would make of its pictures. Shares
/// no projection with what it tests: OpenCV projects.
struct SeenRoom {
  Rig rig = fineRig();
  TagLayout truth = layoutOf(defaultRoomTags());  ///< where the tags really are
  HeadPath head = walkingHead();
  double sigma_px = 0.04;
  double least_side_px = 26;
  double hidden = 0;  ///< part of the tags that is hidden at random, in each picture anew
  std::size_t most_tags = 100, least_tags = 0;  ///< what is left in view (per picture)
  std::mt19937 random{7};

  [[nodiscard]] double readout(std::size_t camera) const {
    return std::chrono::duration<double>(rig.cameras[camera].readout).count();
  }

  /// Pixel of a world point in a picture of that mid-exposure, its row's time allowed for.
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(std::size_t camera,
                                                     std::chrono::nanoseconds mid,
                                                     const Eigen::Vector3d& p_world) const {
    const CameraInfo& info = rig.cameras[camera].info;
    double row = info.height / 2.0 - 0.5;
    Eigen::Vector2d px;
    for (int i = 0; i < (readout(camera) > 0 ? 8 : 1); ++i) {
      const double part = (row + 0.5) / info.height - 0.5;
      const auto at = mid + std::chrono::nanoseconds(std::llround(1e9 * part * readout(camera)));
      const Eigen::Isometry3d T_world_camera = head(at) * rig.T_head_camera(camera);
      const Eigen::Vector3d p = T_world_camera.inverse() * p_world;
      if (p.z() < 0.05 || p.head<2>().norm() > 1.2 * p.z()) return std::nullopt;
      px = lab::projectByOpenCv(info, {p}).front();
      row = std::clamp(px.y(), -0.5, info.height - 0.5);
    }
    return px;
  }

  [[nodiscard]] HeadPicture picture(std::size_t camera, std::chrono::nanoseconds mid) {
    HeadPicture picture{camera, mid - rig.cameras[camera].time_offset, {}};
    std::normal_distribution<double> noise(0, 1);
    for (const MappedTag& tag : truth.tags) {
      TagDetection seen;
      seen.id = tag.id;
      seen.margin = 100;
      seen.refined = true;
      if (!project(camera, mid, tag, seen)) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        seen.corners_px[i] += sigma_px * Eigen::Vector2d(noise(random), noise(random));
        seen.sigma_px[i] = sigma_px;
      }
      picture.tags.push_back(seen);
    }
    hideSome(picture.tags);
    return picture;
  }

  /// Both eyes, exposed together.
  [[nodiscard]] std::vector<HeadPicture> pair(std::chrono::nanoseconds mid) {
    std::vector<HeadPicture> pictures;
    for (std::size_t camera = 0; camera < rig.cameras.size(); ++camera) {
      pictures.push_back(picture(camera, mid));
    }
    return pictures;
  }

 private:
  bool project(std::size_t camera, std::chrono::nanoseconds mid, const MappedTag& tag,
               TagDetection& seen) {
    const CameraInfo& info = rig.cameras[camera].info;
    const Eigen::Vector3d eye = (head(mid) * rig.T_head_camera(camera)).translation();
    const Eigen::Vector3d to_eye = eye - tag.T_world_tag.translation();
    if (tag.T_world_tag.linear().col(2).dot(to_eye.normalized()) < 0.25) return false;
    const auto p_tag = tagCorners(tag.size_m);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto px = pixel(camera, mid, tag.T_world_tag * p_tag[i]);
      if (!px || px->minCoeff() < 4 || px->x() > info.width - 5 || px->y() > info.height - 5) {
        return false;
      }
      seen.corners_px[i] = *px;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if ((seen.corners_px[i] - seen.corners_px[(i + 1) % 4]).norm() < least_side_px) return false;
    }
    return true;
  }

  void hideSome(std::vector<TagDetection>& tags) {
    std::shuffle(tags.begin(), tags.end(), random);
    const auto left = static_cast<std::size_t>(std::lround((1 - hidden) * double(tags.size())));
    const std::size_t keep = std::min(most_tags, std::max(left, least_tags));
    if (tags.size() > keep) tags.resize(keep);
  }
};

inline std::chrono::nanoseconds atFrame(int k, double fps = 30) {
  return std::chrono::nanoseconds(std::llround(1e9 * k / fps));
}

}  // namespace slamscope::tracking::testing
