// SPDX-License-Identifier: MIT
#include "tracking/tag_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "tracking/tag_pose.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector3d;

constexpr int kWindow = 10, kVotes = 6;
constexpr double kSameRay = 0.006;  // rad
constexpr double kOtherSize = 0.03;
constexpr double kNear = 0.5;  // sides of a tag

template <typename... Values>
std::string complaint(const char* format, Values... values) {
  std::array<char, 160> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

/// The four corners as they would be without the row's delay.
TagDetection unrolled(std::span<const EyeCamera> eyes, std::span<const HeadSight> square,
                      const HeadMotion& motion) {
  TagDetection tag;
  tag.id = square[0].tag;
  for (std::size_t i = 0; i < 4; ++i) {
    const HeadSight& sight = square[i];
    const EyeCamera& eye = eyes[sight.camera];
    tag.corners_px[i] = sight.px;
    tag.sigma_px[i] = sight.sigma_px;
    const auto then = projectAt(eye, motion, sight.p_world, sight.delay);
    const auto now = projectAt(eye, motion, sight.p_world, 0);
    if (then && now) tag.corners_px[i] += *now - *then;
  }
  return tag;
}

}  // namespace

/// A tag that isn't where the layout has it.
struct TagFaults::Stray {
  const MappedTag* tag;
  std::size_t camera;
  Isometry3d T_world_tag;  // as seen
  Vector3d eye_world;      // from where

  [[nodiscard]] double shift() const {
    return (T_world_tag.translation() - tag->T_world_tag.translation()).norm();
  }
  [[nodiscard]] bool at(const MappedTag& other) const {
    return (T_world_tag.translation() - other.T_world_tag.translation()).norm() <
           kNear * other.size_m;
  }
  /// How large it is when it is where the layout has it and only looks nearer or further: its size
  /// over the stated one. Nothing where it lies in another direction.
  [[nodiscard]] std::optional<double> sizeRatio() const {
    const Vector3d seen = T_world_tag.translation() - eye_world;
    const Vector3d mapped = tag->T_world_tag.translation() - eye_world;
    const double ratio = mapped.norm() / seen.norm();
    const double angle = seen.cross(mapped).norm() / (seen.norm() * mapped.norm());
    if (angle > kSameRay || std::abs(ratio - 1) < kOtherSize) return std::nullopt;
    return ratio;
  }
};

std::vector<TagFaults::Stray> TagFaults::straysOf(std::span<const EyeCamera> eyes,
                                                  const TagLayout& layout,
                                                  std::span<const HeadSight> sights,
                                                  const HeadFit& fit) {
  std::vector<Stray> strays;
  for (std::size_t i = 0; i + 3 < sights.size(); i += 4) {
    const auto square = sights.subspan(i, 4);
    const auto first = fit.used.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::any_of(first, first + 4, [](bool used) { return used; })) continue;
    const MappedTag* tag = layout.find(square[0].tag);
    const EyeCamera& eye = eyes[square[0].camera];
    const Isometry3d T_world_camera = fit.motion.T_world_head * eye.T_head_camera;
    const TagLayout alone{layout.family, {{tag->id, tag->size_m, Isometry3d::Identity()}}};
    const TagDetection seen = unrolled(eyes, square, fit.motion);
    TagPoseOptions options;
    options.prior_T_camera_world = T_world_camera.inverse() * tag->T_world_tag;
    const auto pose = estimateTagPose(eye.model, alone, std::span(&seen, 1), options);
    if (!pose) continue;
    strays.push_back({tag, square[0].camera, T_world_camera * pose->T_camera_world,
                      T_world_camera.translation()});
  }
  return strays;
}

void TagFaults::age(std::span<const HeadSight> sights) {
  std::set<int> seen;
  for (const HeadSight& sight : sights) seen.insert(sight.tag);
  for (auto& [key, votes] : votes_) {
    // Which tag another stands in the place of says nothing of that one.
    const bool of_both = key.kind == Kind::swapped;
    if (!seen.contains(key.first) && !(of_both && seen.contains(key.second))) continue;
    for (Vote& one : votes) ++one.age;
    std::erase_if(votes, [](const Vote& one) { return one.age >= kWindow; });
  }
  std::erase_if(votes_, [](const auto& entry) { return entry.second.empty(); });
}

void TagFaults::vote(const Key& key, double amount) {
  auto& votes = votes_[key];
  if (votes.empty() || votes.back().age > 0) votes.push_back({0, amount});
}

void TagFaults::add(std::span<const EyeCamera> eyes, const TagLayout& layout,
                    std::span<const HeadSight> sights, const HeadFit& fit) {
  layout_ = layout;
  age(sights);
  std::set<std::pair<std::size_t, int>> squares;  // camera, id
  std::set<int> doubled;
  for (std::size_t i = 0; i + 3 < sights.size(); i += 4) {
    if (!squares.emplace(sights[i].camera, sights[i].tag).second) doubled.insert(sights[i].tag);
  }
  for (const int id : doubled) vote({Kind::twice, id, -1}, 0);
  const std::vector<Stray> strays = straysOf(eyes, layout, sights, fit);
  for (const Stray& stray : strays) {
    const int id = stray.tag->id;
    if (doubled.contains(id)) continue;
    const auto place = std::find_if(layout.tags.begin(), layout.tags.end(), [&](const auto& t) {
      return t.id != id && stray.at(t) && !stray.at(*stray.tag);
    });
    const auto back = std::find_if(strays.begin(), strays.end(), [&](const Stray& other) {
      return place != layout.tags.end() && other.tag->id == place->id && other.at(*stray.tag);
    });
    if (back != strays.end()) {
      vote({Kind::swapped, std::min(id, place->id), std::max(id, place->id)}, 0);
    }
    if (place != layout.tags.end()) {  // said where the other one isn't seen often enough
      vote({Kind::in_place_of, id, place->id}, 0);
    } else if (const auto ratio = stray.sizeRatio()) {
      vote({Kind::size, id, -1}, *ratio * stray.tag->size_m);
    } else {
      vote({Kind::moved, id, -1}, stray.shift());
    }
  }
}

std::string TagFaults::text(const Key& key, double amount, const TagLayout& layout) {
  switch (key.kind) {
    case Kind::moved:
      return complaint("tag %d has moved by %.3f m", key.first, amount);
    case Kind::size:
      return complaint("tag %d looks %.3f m wide where %.3f m is stated", key.first, amount,
                       layout.find(key.first)->size_m);
    case Kind::swapped:
      return complaint("tags %d and %d are swapped in the layout", key.first, key.second);
    case Kind::in_place_of:
      return complaint("tag %d stands in the place of tag %d", key.first, key.second);
    case Kind::twice:
      return complaint("tag %d is seen twice", key.first);
  }
  return "";
}

std::vector<std::string> TagFaults::named() const {
  std::vector<std::string> names;
  for (const auto& [key, votes] : votes_) {
    const auto swap = votes_.find(
        {Kind::swapped, std::min(key.first, key.second), std::max(key.first, key.second)});
    const bool said =
        key.kind == Kind::in_place_of && swap != votes_.end() && swap->second.size() >= kVotes;
    if (votes.size() < kVotes || said) continue;
    std::vector<double> amounts;
    for (const Vote& one : votes) amounts.push_back(one.amount);
    const auto middle = amounts.begin() + static_cast<std::ptrdiff_t>(amounts.size() / 2);
    std::nth_element(amounts.begin(), middle, amounts.end());
    names.push_back(text(key, *middle, layout_));
  }
  return names;
}

}  // namespace slamscope::tracking
