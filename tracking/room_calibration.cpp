// SPDX-License-Identifier: MIT
#include "tracking/room_calibration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "tracking/room_bundle.hpp"
#include "tracking/room_start.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::Vector3d;

constexpr std::size_t kLeastWalkPictures = 3;
constexpr double kFullWeightBeyond = 3;  // sigmas
constexpr double kOutlierSigmas = 8, kOutlier_px = 0.7;
constexpr int kGoodSightings = 5;
constexpr double kMostResidual_px = 1.0, kLeastKept = 0.6;

std::string joined(const std::set<int>& ids) {
  std::string text;
  for (const int id : ids) text += (text.empty() ? "" : ", ") + std::to_string(id);
  return text;
}

/// Pictures without tags of no size, and ids that occur twice in one.
std::vector<RoomPicture> usable(std::span<const RoomPicture> pictures,
                                const std::vector<MappedTag>& known) {
  std::vector<RoomPicture> result;
  for (const RoomPicture& picture : pictures) {
    RoomPicture kept{picture.camera, {}};
    for (const TagDetection& tag : picture.tags) {
      const bool is_known =
          std::any_of(known.begin(), known.end(), [&](const auto& k) { return k.id == tag.id; });
      const auto same = std::count_if(picture.tags.begin(), picture.tags.end(),
                                      [&](const auto& other) { return other.id == tag.id; });
      if (is_known && same == 1) kept.tags.push_back(tag);
    }
    result.push_back(std::move(kept));
  }
  return result;
}

std::vector<MappedTag> knownTags(std::span<const RoomPicture> pictures,
                                 const RoomCalibrationOptions& options) {
  std::map<int, double> sizes;
  for (const RoomPicture& picture : pictures) {
    for (const TagDetection& tag : picture.tags) {
      const auto own = options.sizes.find(tag.id);
      const double size = own != options.sizes.end() ? own->second : options.size_m;
      if (size > 0) sizes[tag.id] = size;
    }
  }
  std::vector<MappedTag> tags;
  for (const auto& [id, size] : sizes) tags.push_back({id, size, Isometry3d::Identity()});
  return tags;
}

MappedTag chooseGauge(const std::vector<RoomPicture>& pictures, const std::vector<MappedTag>& tags,
                      const RoomCalibrationOptions& options) {
  std::map<int, int> beside;  // how often a tag is seen beside others
  std::size_t count = 0;
  for (const RoomPicture& picture : pictures) {
    if (picture.tags.size() < 2) continue;
    ++count;
    for (const TagDetection& tag : picture.tags) {
      beside[tag.id] += static_cast<int>(picture.tags.size()) - 1;
    }
  }
  if (count < kLeastWalkPictures) {
    throw std::runtime_error("tags: two tags of stated size are seen together in " +
                             std::to_string(count) + " pictures; expected at least 3");
  }
  int id = options.gauge.value_or(-1);
  if (!options.gauge) {
    const auto most = std::max_element(beside.begin(), beside.end(),
                                       [](auto& a, auto& b) { return a.second < b.second; });
    id = most->first;
  } else if (!beside.contains(id)) {
    throw std::runtime_error("tags: the gauge tag " + std::to_string(id) +
                             " is never seen beside another");
  }
  return *std::find_if(tags.begin(), tags.end(), [id](const auto& tag) { return tag.id == id; });
}

/// All sightings by located pictures of placed tags.
Bundle makeBundle(std::span<const CameraModel> cameras, const std::vector<RoomPicture>& pictures,
                  const RoomStart& start, double bias_px) {
  Bundle bundle;
  for (const MappedTag& tag : start.layout.tags) bundle.T_world_tag.push_back(tag.T_world_tag);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    bundle.T_camera_world.push_back(start.T_camera_world[i].value_or(Isometry3d::Identity()));
    if (!start.T_camera_world[i]) continue;
    for (const TagDetection& seen : pictures[i].tags) {
      const MappedTag* tag = start.layout.find(seen.id);
      if (!tag) continue;
      const auto p_tag = tagCorners(tag->size_m);
      for (std::size_t c = 0; c < 4; ++c) {
        const CameraModel& camera = cameras[pictures[i].camera];
        const auto ray = camera.unproject(seen.corners_px[c]);
        if (!ray || ray->z() < 0.05) continue;
        PixelJacobian J;
        const Vector3d on_plane = *ray / ray->z();
        if (!camera.project(on_plane, &J)) continue;
        bundle.corners.push_back({i, static_cast<std::size_t>(tag - start.layout.tags.data()),
                                  p_tag[c], on_plane.head<2>(),
                                  J.leftCols<2>() / std::hypot(seen.sigma_px[c], bias_px)});
      }
    }
  }
  return bundle;
}

double pixelsOf(const BundleCorner& corner, double focal_px, double sigmas) {
  return sigmas * focal_px / std::sqrt(std::abs(corner.to_sigmas.determinant()));
}

/// Turns and moves the world so that the floor tags lie on z = 0, the gauge tag's centre above the
/// origin, its x along x.
void levelWorld(Bundle& bundle) {
  std::vector<Vector3d> corners;
  Vector3d mean = Vector3d::Zero(), up = Vector3d::Zero();
  for (const Bundle::OnFloor& one : bundle.floor) {
    const Isometry3d& T = bundle.T_world_tag[one.tag];
    for (const Vector3d& p : tagCorners(2 * one.half)) corners.push_back(T * p);
    up += T.linear().col(2);
  }
  for (const Vector3d& p : corners) mean += p / static_cast<double>(corners.size());
  Matrix3d S = Matrix3d::Zero();
  for (const Vector3d& p : corners) S += (p - mean) * (p - mean).transpose();
  Vector3d normal = Eigen::SelfAdjointEigenSolver<Matrix3d>(S).eigenvectors().col(0);
  if (normal.dot(up) < 0) normal = -normal;
  const Isometry3d& gauge = bundle.T_world_tag[bundle.gauge];
  Vector3d x = gauge.linear().col(0);
  x -= x.dot(normal) * normal;
  if (x.norm() < 0.1) x = normal.unitOrthogonal();
  x.normalize();
  Isometry3d T_old_new = Isometry3d::Identity();
  T_old_new.linear() << x, normal.cross(x), normal;
  T_old_new.translation() = gauge.translation() - normal.dot(gauge.translation() - mean) * normal;
  for (Isometry3d& T : bundle.T_world_tag) T = T_old_new.inverse() * T;
  for (Isometry3d& T : bundle.T_camera_world) T = T * T_old_new;
}

/// How far floor tags are from z = 0, RMS.
double heightOf(const Bundle& bundle) {
  double sum = 0;
  for (const Bundle::OnFloor& one : bundle.floor) {
    for (const Vector3d& p : tagCorners(2 * one.half)) {
      sum += std::pow((bundle.T_world_tag[one.tag] * p).z(), 2) / 4;
    }
  }
  return bundle.floor.empty() ? 0 : std::sqrt(sum / static_cast<double>(bundle.floor.size()));
}

void dropOutliers(Bundle& bundle, double focal_px) {
  const auto distances = bundleDistances(bundle);
  std::vector<BundleCorner> kept;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const bool fits = distances[i] < kOutlierSigmas ||
                      pixelsOf(bundle.corners[i], focal_px, distances[i]) < kOutlier_px;
    if (fits) kept.push_back(bundle.corners[i]);
  }
  bundle.corners = std::move(kept);
}

void reportResiduals(const Bundle& bundle, double focal_px, RoomCalibration& result) {
  struct Sum {
    double px2 = 0;
    int count = 0;
    [[nodiscard]] double rms() const { return count > 0 ? std::sqrt(px2 / count) : 0; }
  };
  std::vector<Sum> by_picture(bundle.T_camera_world.size()), by_tag(bundle.T_world_tag.size());
  std::vector<std::set<std::size_t>> pictures(by_tag.size());
  Sum all;
  const auto distances = bundleDistances(bundle);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const BundleCorner& corner = bundle.corners[i];
    const double px = pixelsOf(corner, focal_px, distances[i]);
    for (Sum* sum : {&all, &by_picture[corner.picture], &by_tag[corner.tag]}) {
      sum->px2 += px * px;
      ++sum->count;
    }
    pictures[corner.tag].insert(corner.picture);
  }
  result.residual_px = all.rms();
  for (const Sum& sum : by_picture) {
    result.picture_px.push_back(sum.count > 0 ? std::optional(sum.rms()) : std::nullopt);
  }
  for (std::size_t i = 0; i < by_tag.size(); ++i) {
    result.tags.push_back(
        {result.layout.tags[i].id, static_cast<int>(pictures[i].size()), by_tag[i].rms()});
  }
}

std::vector<int> cornersByTag(const Bundle& bundle) {
  std::vector<int> counts(bundle.T_world_tag.size(), 0);
  for (const BundleCorner& corner : bundle.corners) ++counts[corner.tag];
  return counts;
}

[[noreturn]] void refuseAsContradictory(const std::string& evidence) {
  throw std::runtime_error("tags: the pictures contradict each other (" + evidence +
                           "): is a size or the camera's calibration wrong?");
}

/// Tags of which more corners had to be left out than is chance.
void refuseMisfits(const TagLayout& layout, const std::vector<int>& all,
                   const std::vector<int>& kept) {
  std::set<int> ids;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i] < kLeastKept * all[i]) ids.insert(layout.tags[i].id);
  }
  if (ids.empty()) return;
  // Of most tags at once it isn't their fault.
  if (2 * ids.size() > all.size()) {
    refuseAsContradictory(std::to_string(ids.size()) + " of " + std::to_string(all.size()) +
                          " tags fit the others in few of them only");
  }
  throw std::runtime_error("tags: " + joined(ids) +
                           " fit the others in few pictures only: of another size than stated, or "
                           "moved during the walk?");
}

void refuseContradiction(double residual_px) {
  if (residual_px < kMostResidual_px) return;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "residual %.2f px", residual_px);
  refuseAsContradictory(text.data());
}

void hintAt(RoomCalibration& result) {
  for (const CalibratedTag& tag : result.tags) {
    if (tag.pictures < kGoodSightings) {
      result.hints.push_back("tag " + std::to_string(tag.id) + " is in " +
                             std::to_string(tag.pictures) +
                             " pictures only; look at it more, beside others");
    }
    if (tag.residual_px > 3 * result.residual_px && tag.residual_px > 0.5) {
      result.hints.push_back("tag " + std::to_string(tag.id) +
                             " fits worst; is it flat, and of the stated size?");
    }
  }
}

}  // namespace

RoomCalibration calibrateRoom(std::span<const CameraModel> cameras,
                              std::span<const RoomPicture> pictures,
                              const RoomCalibrationOptions& options) {
  const std::vector<MappedTag> known = knownTags(pictures, options);
  const std::vector<RoomPicture> used = usable(pictures, known);
  const MappedTag gauge = chooseGauge(used, known, options);
  const RoomStart start = startRoom(cameras, used, gauge, known, options.family);
  std::set<int> unreached;
  for (const MappedTag& tag : known) {
    if (!start.layout.find(tag.id)) unreached.insert(tag.id);
  }
  if (!unreached.empty()) {
    throw std::runtime_error("tags: " + joined(unreached) + " " +
                             (unreached.size() == 1 ? "is" : "are") +
                             " never seen beside the others; walk so that two are in each picture");
  }
  Bundle bundle = makeBundle(cameras, used, start, options.corner_bias_px);
  const double focal_px = cameras.front().K()(0, 0);
  // Ever narrower: at first nearly all corners are off by more than they are in the end.
  for (const double full_weight : {300.0, 30.0, kFullWeightBeyond}) adjust(bundle, full_weight);
  for (const int id : options.floor) {
    const MappedTag* tag = start.layout.find(id);
    if (!tag) throw std::runtime_error("tags: floor tag " + std::to_string(id) + " is never seen");
    bundle.floor.push_back(
        {static_cast<std::size_t>(tag - start.layout.tags.data()), tag->size_m / 2});
  }
  if (!bundle.floor.empty()) levelWorld(bundle);
  const std::vector<int> all = cornersByTag(bundle);
  dropOutliers(bundle, focal_px);
  refuseMisfits(start.layout, all, cornersByTag(bundle));
  adjust(bundle, kFullWeightBeyond);

  RoomCalibration result;
  result.layout = start.layout;
  for (std::size_t i = 0; i < bundle.T_world_tag.size(); ++i) {
    result.layout.tags[i].T_world_tag = bundle.T_world_tag[i];
  }
  result.floor_m = heightOf(bundle);
  reportResiduals(bundle, focal_px, result);
  refuseContradiction(result.residual_px);
  hintAt(result);
  std::sort(result.layout.tags.begin(), result.layout.tags.end(),
            [](const auto& a, const auto& b) { return a.id < b.id; });
  return result;
}

}  // namespace slamscope::tracking
