// SPDX-License-Identifier: MIT
#include "tracking/head_start.hpp"

#include <algorithm>
#include <cmath>

#include "tracking/tag_pose.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;

constexpr double kSameTurn = 0.01;       // rad; nearer than that two fits are one
constexpr double kDecisive = 20;         // difference of χ²: odds of 20,000 to 1
constexpr double kMostErrorRatio = 0.2;  // of one tag; n tags count n times

double turnBetween(const Isometry3d& a, const Isometry3d& b) {
  return rotationLog(a.linear().transpose() * b.linear()).norm();
}

/// Poses of the head by each picture alone; by one only where it leaves no doubt.
std::vector<Isometry3d> posesByPicture(std::span<const EyeCamera> eyes, const TagLayout& layout,
                                       std::span<const EyeSight> pictures) {
  std::vector<Isometry3d> poses;
  for (const EyeSight& picture : pictures) {
    const EyeCamera& eye = eyes[picture.camera];
    const auto pose = estimateTagPose(eye.model, layout, picture.tags);
    if (!pose) continue;
    const Isometry3d T_camera_head = eye.T_head_camera.inverse();
    poses.push_back(pose->T_camera_world.inverse() * T_camera_head);
    if (pose->other) poses.push_back(pose->other->inverse() * T_camera_head);
    if (!pose->ambiguous && pose->tags >= 3 && pose->rejected_ids.empty()) break;
  }
  return poses;
}

/// χ² of the corners that `best` uses, under each of the two.
bool decidedlyBetter(std::span<const EyeCamera> eyes, std::span<const HeadSight> sights,
                     const HeadFit& best, const HeadFit& other) {
  const auto first = headDistances(eyes, sights, best.motion);
  const auto second = headDistances(eyes, sights, other.motion);
  double chi2_first = 0, chi2_second = 0;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (!best.used[i]) continue;
    const double weight = 1 / (sights[i].sigma_px * sights[i].sigma_px);
    chi2_first += weight * first[i] * first[i];
    chi2_second += weight * second[i] * second[i];
  }
  const double ratio = std::sqrt(chi2_first / std::max(chi2_second, 1e-12));
  const double noise = std::max(1.0, chi2_first / std::max(1, 2 * best.used_count - 6));
  return std::pow(ratio, best.used_count / 4.0) <= kMostErrorRatio &&
         (chi2_second - chi2_first) / noise >= kDecisive;
}

HeadMotion unknownMotion(const Isometry3d& T_world_head, const HeadStartOptions& options) {
  HeadMotion motion;
  motion.time = options.time;
  motion.T_world_head = T_world_head;
  motion.covariance.diagonal() << Vector3d::Constant(1e4), Vector3d::Constant(1e2),
      Vector3d::Constant(options.sigma_v * options.sigma_v),
      Vector3d::Constant(options.sigma_omega * options.sigma_omega),
      Vector3d::Constant(options.sigma_alpha * options.sigma_alpha),
      Vector3d::Constant(options.sigma_jerk * options.sigma_jerk);
  return motion;
}

}  // namespace

std::vector<HeadSight> sightsOf(std::span<const EyeCamera> eyes, const TagLayout& layout,
                                std::span<const EyeSight> pictures, double corner_bias_px) {
  std::vector<HeadSight> sights;
  int square = 0;
  for (const EyeSight& picture : pictures) {
    const EyeCamera& eye = eyes[picture.camera];
    for (const TagDetection& seen : picture.tags) {
      const MappedTag* tag = layout.find(seen.id);
      if (!tag) continue;
      const auto p_tag = tagCorners(tag->size_m);
      for (std::size_t i = 0; i < 4; ++i) {
        sights.push_back({picture.camera, tag->T_world_tag * p_tag[i], seen.corners_px[i],
                          std::hypot(seen.sigma_px[i], corner_bias_px),
                          picture.delay + eye.rowDelay(seen.corners_px[i].y()), tag->id, square});
      }
      ++square;
    }
  }
  return sights;
}

std::vector<HeadFit> findHead(std::span<const EyeCamera> eyes, const TagLayout& layout,
                              std::span<const EyeSight> pictures, std::span<const HeadSight> sights,
                              const HeadStartOptions& options) {
  struct Found {
    HeadFit fit;
    double misfit;
  };
  std::vector<Found> found;
  for (const Isometry3d& start : posesByPicture(eyes, layout, pictures)) {
    const HeadMotion unknown = unknownMotion(start, options);
    const HeadFitProblem problem{eyes, sights, unknown, false, options.gate_sigmas};
    auto fit = fitHeadWarily(problem, unknown);
    if (!fit) continue;
    const auto same = [&](const Found& other) {
      return turnBetween(other.fit.motion.T_world_head, fit->motion.T_world_head) < kSameTurn;
    };
    if (std::any_of(found.begin(), found.end(), same)) continue;
    const double misfit = headMisfit(headDistances(eyes, sights, fit->motion));
    found.push_back({std::move(*fit), misfit});
  }
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.misfit < b.misfit; });
  const auto implausible = [&](const Found& one) {
    return options.plausible && !options.plausible(one.fit.motion.T_world_head);
  };
  if (!std::all_of(found.begin(), found.end(), implausible)) std::erase_if(found, implausible);
  std::vector<HeadFit> result;
  if (!found.empty()) result.push_back(std::move(found[0].fit));
  if (found.size() > 1 && !decidedlyBetter(eyes, sights, result[0], found[1].fit)) {
    result.push_back(std::move(found[1].fit));
  }
  return result;
}

std::vector<Isometry3d> otherPoses(std::span<const EyeCamera> eyes, const TagLayout& layout,
                                   std::span<const EyeSight> pictures, const HeadMotion& motion) {
  std::vector<Isometry3d> others;
  for (const Isometry3d& pose : posesByPicture(eyes, layout, pictures)) {
    if (turnBetween(pose, motion.T_world_head) > 5 * kSameTurn) others.push_back(pose);
  }
  return others;
}

}  // namespace slamscope::tracking
