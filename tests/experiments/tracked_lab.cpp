// SPDX-License-Identifier: MIT
#include "tests/experiments/tracked_lab.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>

#include "tests/experiments/progress.hpp"
#include "tracking/head_overlay.hpp"
#include "tracking/tag_search.hpp"

namespace slamscope::tracking::experiments {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr int kSettled = 3;  // frames

/// Milliseconds of the processor, so that others on the machine don't count.
double since(std::clock_t start) {
  return 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

bool inPicture(const Vector2d& px, const CameraInfo& info) {
  return px.x() >= 0 && px.y() >= 0 && px.x() <= info.width - 1 && px.y() <= info.height - 1;
}

/// Drawn against true pixels of a raster of the floor.
void compareOverlay(const StereoLab& lab, const HeadTracker& tracker, std::uint64_t k,
                    TrackedLab& result) {
  const Rig& rig = lab.options().rig;
  for (double x = -1.2; x < 1.21; x += 0.2) {
    for (double y = -1.2; y < 1.21; y += 0.2) {
      double rows = 0;
      int eyes = 0;
      for (std::size_t eye = 0; eye < rig.cameras.size(); ++eye) {
        const auto pose = tracker.at(lab.time(eye, k));
        if (!pose) continue;
        const auto drawn = projectRolling(EyeCamera(rig, eye), pose->motion, {x, y, 0});
        const auto truth = lab.truePixel(eye, k, {x, y, 0});
        if (!drawn || !truth || !inPicture(*truth, rig.cameras[eye].info)) continue;
        result.overlay_px.push_back((*drawn - *truth).norm());
        rows += (eye == 0 ? 1 : -1) * (drawn->y() - truth->y());
        ++eyes;
      }
      if (eyes == 2) result.disparity_px.push_back(std::abs(rows));
    }
  }
}

}  // namespace

TrackedLab trackLab(const StereoLabOptions& options, int frames) {
  const StereoLab lab(options);
  const Rig& rig = options.rig;
  HeadTracker tracker(rig, *lab.tags());
  std::vector<TagSearch> searches;
  for (std::size_t eye = 0; eye < rig.cameras.size(); ++eye)
    searches.emplace_back(EyeCamera(rig, eye), *lab.tags());
  slam::experiments::Progress progress("lab", frames);
  TrackedLab result;
  for (int k = 0; k < frames; ++k) {
    const auto frame = static_cast<std::uint64_t>(k);
    const StereoFrame both = lab.pair(frame);
    const auto start = std::clock();
    std::vector<HeadPicture> pictures;
    for (std::size_t eye = 0; eye < rig.cameras.size(); ++eye) {
      const auto begin = std::clock();
      std::optional<HeadMotion> motion;
      if (const auto pose = tracker.at(lab.time(eye, frame))) motion = pose->motion;
      pictures.push_back({eye, both.eyes[eye]->time, searches[eye].find(*both.eyes[eye], motion)});
      if (k > 0) result.find_ms.push_back(since(begin));
    }
    const auto begin = std::clock();
    tracker.add(pictures);
    if (k > 0) result.track_ms.push_back(since(begin));
    if (k == 0) result.first_ms = since(start);
    ++result.frames;
    progress.done();
    const auto pose = tracker.at(lab.time(0, frame));
    if (!pose || pose->state != HeadState::tracking) continue;
    ++result.tracked;
    if (k < kSettled) continue;
    result.least_tags = std::min(result.least_tags, tracker.last().tags_used);
    result.T_world_head.push_back(pose->motion.T_world_head);
    compareOverlay(lab, tracker, frame, result);
  }
  return result;
}

Jitter jitterOf(const std::vector<Isometry3d>& poses) {
  if (poses.empty()) return {};
  const double n = static_cast<double>(poses.size());
  Vector3d place = Vector3d::Zero(), turn = Vector3d::Zero();
  std::vector<Vector3d> turns;
  for (const Isometry3d& T : poses) {
    place += T.translation() / n;
    turns.push_back(rotationLog(poses[0].linear().transpose() * T.linear()));
    turn += turns.back() / n;
  }
  double metres = 0, radians = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    metres += (poses[i].translation() - place).squaredNorm() / n;
    radians += (turns[i] - turn).squaredNorm() / n;
  }
  return {std::sqrt(radians) * 180 / std::numbers::pi, std::sqrt(metres)};
}

double quantileOf(std::vector<double> values, double part) {
  if (values.empty()) return 1e9;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace slamscope::tracking::experiments
