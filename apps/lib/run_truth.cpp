// SPDX-License-Identifier: MIT
#include "apps/lib/run_truth.hpp"

#include <algorithm>
#include <memory>

#include "apps/lib/drawable_run.hpp"
#include "slam/angle.hpp"
#include "slam/laser_lab.hpp"

namespace slamscope::apps {
namespace {

using std::chrono::nanoseconds;

struct TruePath {
  std::vector<nanoseconds> times;
  std::vector<Eigen::Vector3d> poses;

  [[nodiscard]] Eigen::Vector3d at(nanoseconds time) const {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return poses.front();
    if (after == times.end()) return poses.back();
    const auto k = static_cast<std::size_t>(after - times.begin());
    const double share = std::chrono::duration<double>(time - times[k - 1]) /
                         std::chrono::duration<double>(times[k] - times[k - 1]);
    Eigen::Vector3d pose = poses[k - 1] + share * (poses[k] - poses[k - 1]);
    pose.z() = slam::wrapAngle(poses[k - 1].z() +
                               share * slam::wrapAngle(poses[k].z() - poses[k - 1].z()));
    return pose;
  }
};

}  // namespace

std::optional<RunTruth> truthOfRun(const std::string& path) {
  slam::RunReader reader = openDrawable(path);
  RunTruth truth;
  const auto true_path = std::make_shared<TruePath>();
  bool first = true;
  while (const auto next = reader.next()) {
    const slam::Snapshot& snapshot = **next;
    if (first) truth.start = snapshot.time;
    first = false;
    truth.end = snapshot.time;
    if (!snapshot.truth) continue;
    const slam::Truth& known = *snapshot.truth;
    if (known.features.size() >= truth.features.size()) {
      truth.ids = known.ids;
      truth.features = known.features;
    }
    if (known.pose.allFinite() &&
        (true_path->times.empty() || true_path->times.back() < snapshot.time)) {
      true_path->times.push_back(snapshot.time);
      true_path->poses.push_back(known.pose);
    }
  }
  if (true_path->times.empty()) return std::nullopt;
  truth.pose = [true_path](nanoseconds time) { return true_path->at(time); };
  return truth;
}

RunTruth truthOfSimulation(const slam::SimulationOptions& options) {
  const auto simulation = std::make_shared<slam::Simulation>(options);
  RunTruth truth;
  truth.end = simulation->duration();
  truth.ids = simulation->truth().ids;
  truth.features = simulation->truth().features;
  truth.pose = [simulation](nanoseconds time) { return simulation->truePose(time); };
  return truth;
}

slam::LaserLab laserLabOf(const slam::SimulationOptions& options) {
  return slam::LaserLab({.loops = options.loops, .seed = options.seed});
}

RunTruth truthOfLaserLab(const slam::LaserLab& lab) {
  RunTruth truth;
  truth.end = lab.drive().timeOf(lab.drive().stepCount());
  truth.ids = lab.posts().ids;
  truth.features = lab.posts().features;
  truth.pose = [drive = lab.drive()](nanoseconds time) { return drive.poseAt(time); };
  truth.walls = lab.walls();
  truth.post_radius = lab.postRadius();
  return truth;
}

}  // namespace slamscope::apps
