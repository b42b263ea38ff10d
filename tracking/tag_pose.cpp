// SPDX-License-Identifier: MIT
#include "tracking/tag_pose.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>

#include "tracking/tag_scene.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr std::size_t kRefined = 6;   // of the candidates
constexpr double kMostError_px = 20;  // an outlier weighs no more when candidates are compared
constexpr double kDoubtful = 0.5;     // misfit: errors of 0.4 px
constexpr std::size_t kMostLeftOut = 12;
constexpr double kDecisiveChi2 = 20;    // odds of 20,000 to 1
constexpr double kSameRotation = 0.01;  // rad; nearer than that two fits are one

struct Candidate {
  Isometry3d T_camera_world;
  double misfit = 0;
};

/// Points for OpenCV: object in metres, image in the plane z = 1 (lens and K taken off).
struct Points {
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  void add(const CameraModel& camera, const Vector3d& p, const Vector2d& px) {
    const auto ray = camera.unproject(px);
    if (!ray || ray->z() < 0.02) return;
    object.emplace_back(p.x(), p.y(), p.z());
    image.emplace_back(ray->x() / ray->z(), ray->y() / ray->z());
  }
};

std::vector<Isometry3d> solvePnP(const Points& points, cv::SolvePnPMethod method) {
  std::vector<Isometry3d> poses;
  std::vector<cv::Mat> rotations, translations;
  try {
    cv::solvePnPGeneric(points.object, points.image, cv::Mat::eye(3, 3, CV_64F), cv::noArray(),
                        rotations, translations, false, method);
  } catch (const cv::Exception&) {  // degenerate points: other candidates remain
    return poses;
  }
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    cv::Matx33d R;
    cv::Rodrigues(rotations[i], R);
    Isometry3d T = Isometry3d::Identity();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) T.linear()(r, c) = R(r, c);
      T.translation()[r] = translations[i].at<double>(r);
    }
    if (T.matrix().allFinite()) poses.push_back(T);
  }
  return poses;
}

struct Seen {
  const MappedTag* tag;
  const TagDetection* detection;
};

std::vector<CornerSight> cornersOf(const std::vector<Seen>& seen) {
  std::vector<CornerSight> corners;
  for (const auto& [tag, detection] : seen) {
    const auto p_tag = tagCorners(tag->size_m);
    for (std::size_t i = 0; i < 4; ++i) {
      corners.push_back({tag->T_world_tag * p_tag[i], false, detection->corners_px[i],
                         detection->sigma_px[i], tag->id});
    }
  }
  return corners;
}

/// Both planar poses of each tag, those of all corners together, the prior, and where these leave
/// doubt those of all tags but one; best first.
std::vector<Candidate> candidates(const CameraModel& camera, const std::vector<Seen>& seen,
                                  const std::vector<CornerSight>& corners,
                                  const std::optional<Isometry3d>& prior) {
  std::vector<Candidate> list;
  const auto add = [&](const Isometry3d& T) {
    list.push_back({T, sceneMisfit(camera, corners, {T, Isometry3d::Identity()})});
  };
  for (const auto& [tag, detection] : seen) {
    // IPPE_SQUARE wants the corners clockwise from the upper left.
    const auto p_tag = tagCorners(tag->size_m);
    Points points;
    for (const std::size_t i : {3, 2, 1, 0}) points.add(camera, p_tag[i], detection->corners_px[i]);
    if (points.object.size() < 4) continue;
    for (const Isometry3d& T_camera_tag : solvePnP(points, cv::SOLVEPNP_IPPE_SQUARE)) {
      add(T_camera_tag * tag->T_world_tag.inverse());
    }
  }
  const auto add_joint = [&](int without) {
    Points points;
    for (const CornerSight& corner : corners) {
      if (corner.tag != without) points.add(camera, corner.p, corner.px);
    }
    if (points.object.size() < 8) return;
    for (const Isometry3d& T : solvePnP(points, cv::SOLVEPNP_SQPNP)) add(T);
  };
  constexpr int kNone = -1;
  add_joint(kNone);
  if (prior) add(*prior);
  const auto better = [](const Candidate& a, const Candidate& b) { return a.misfit < b.misfit; };
  const bool doubtful =
      list.empty() || std::min_element(list.begin(), list.end(), better)->misfit > kDoubtful;
  if (doubtful && seen.size() > 2 && seen.size() <= kMostLeftOut) {
    for (const Seen& one : seen) add_joint(one.tag->id);  // if it is one tag that is wrong
  }
  std::sort(list.begin(), list.end(), better);
  return list;
}

double angleBetween(const Isometry3d& a, const Isometry3d& b) {
  return std::abs(Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle());
}

struct Refined {
  SceneFit fit;
  double misfit;
};

/// Distinct poses that the data come to rest at, best first.
std::vector<Refined> refine(const CameraModel& camera, const SceneProblem& problem,
                            const std::vector<Candidate>& starts) {
  std::vector<Refined> found;
  std::vector<Isometry3d> tried;
  for (const Candidate& start : starts) {
    const auto near = [&](const Isometry3d& T) {
      return angleBetween(T, start.T_camera_world) < 5 * kSameRotation;
    };
    if (tried.size() >= kRefined) break;
    if (std::any_of(tried.begin(), tried.end(), near)) continue;
    tried.push_back(start.T_camera_world);
    const auto fit = fitScene(camera, problem, {start.T_camera_world, Isometry3d::Identity()});
    if (!fit) continue;
    const auto same = [&](const Refined& other) {
      return angleBetween(other.fit.pose.T_camera_world, fit->pose.T_camera_world) < kSameRotation;
    };
    if (std::any_of(found.begin(), found.end(), same)) continue;
    found.push_back({*fit, sceneMisfit(camera, problem.corners, fit->pose)});
  }
  std::sort(found.begin(), found.end(),
            [](const Refined& a, const Refined& b) { return a.misfit < b.misfit; });
  return found;
}

/// Tags of which at least two corners are outliers.
std::vector<int> rejectedIds(const std::vector<CornerSight>& corners, const SceneFit& fit) {
  std::vector<int> ids;
  for (std::size_t i = 0; i + 3 < corners.size(); i += 4) {
    const auto first = fit.used.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::count(first, first + 4, false) >= 2) ids.push_back(corners[i].tag);
  }
  return ids;
}

/// How the best pose compares to another one, over the corners that fit the best.
struct Comparison {
  double error_ratio;  // of root mean squares
  bool undecided;
};

Comparison compare(const CameraModel& camera, const std::vector<CornerSight>& corners,
                   const SceneFit& best, const SceneFit& other, double max_ratio_of_one_tag) {
  const auto first = sceneDistances(camera, corners, best.pose);
  const auto second = sceneDistances(camera, corners, other.pose);
  double chi2_first = 0, chi2_second = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!best.used[i]) continue;
    chi2_first += first[i] * first[i];
    chi2_second += second[i] * second[i];
  }
  Comparison result;
  result.error_ratio = std::sqrt(chi2_first / std::max(chi2_second, 1e-12));
  // A small ratio may be chance: with six unknowns, eight coordinates leave little error to any
  // pose. So the poses must differ by what noise won't do as well.
  const double noise = std::max(1.0, chi2_first / std::max(1, 2 * best.used_count - 6));
  result.undecided = std::pow(result.error_ratio, best.used_count / 4.0) > max_ratio_of_one_tag ||
                     (chi2_second - chi2_first) / noise < kDecisiveChi2;
  return result;
}

}  // namespace

std::optional<TagPose> estimateTagPose(const CameraModel& camera, const TagLayout& layout,
                                       std::span<const TagDetection> detections,
                                       const TagPoseOptions& options) {
  std::vector<Seen> seen;
  for (const TagDetection& detection : detections) {
    if (const MappedTag* tag = layout.find(detection.id)) seen.push_back({tag, &detection});
  }
  if (seen.empty()) return std::nullopt;
  SceneProblem problem;
  problem.corners = cornersOf(seen);
  problem.gate_sigmas = options.gate_sigmas;
  problem.robust = seen.size() > 1;
  const auto& prior = options.prior_T_camera_world;
  auto found = refine(camera, problem, candidates(camera, seen, problem.corners, prior));
  if (found.empty()) return std::nullopt;

  TagPose pose;
  if (found.size() > 1) {
    const Comparison comparison =
        compare(camera, problem.corners, found[0].fit, found[1].fit, options.max_error_ratio);
    pose.error_ratio = comparison.error_ratio;
    pose.ambiguous = comparison.undecided;
    if (pose.ambiguous && prior) {
      const double first = angleBetween(found[0].fit.pose.T_camera_world, *prior);
      const double second = angleBetween(found[1].fit.pose.T_camera_world, *prior);
      if (second < first) {
        std::swap(found[0], found[1]);
        pose.error_ratio = 1 / pose.error_ratio;
      }
      // A prior half-way between the two decides nothing.
      pose.ambiguous = std::min(first, second) > 0.5 * std::max(first, second);
    }
    pose.other = found[1].fit.pose.T_camera_world;
  }
  const SceneFit& best = found[0].fit;
  pose.T_camera_world = best.pose.T_camera_world;
  pose.covariance = best.covariance.topLeftCorner<6, 6>();
  pose.residual_px = best.residual_px;
  pose.corners = best.used_count;
  pose.rejected_ids = rejectedIds(problem.corners, best);
  pose.tags = static_cast<int>(seen.size() - pose.rejected_ids.size());
  if (pose.tags == 0) return std::nullopt;
  return pose;
}

}  // namespace slamscope::tracking
