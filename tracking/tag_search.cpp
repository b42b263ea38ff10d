// SPDX-License-Identifier: MIT
#include "tracking/tag_search.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::tracking {
namespace {

constexpr double kSeenFromFront = 0.1;  // cosine to the tag's normal; more aslant it isn't expected
constexpr int kMirrorAfter = 10;        // pictures without a tag

TagDetectorOptions detectorOf(const TagSearchOptions& options, const CameraModel& camera) {
  TagDetectorOptions result = options.detector;
  result.camera = camera;
  return result;
}

/// The same picture, left and right exchanged.
std::vector<std::uint8_t> mirrorImage(const ImageView& picture) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<std::uint8_t> mirror;
  mirror.reserve(width * channels * static_cast<std::size_t>(picture.height));
  for (int row = 0; row < picture.height; ++row) {
    const std::uint8_t* first = picture.pixels + static_cast<std::size_t>(row) * picture.row_bytes;
    for (std::size_t column = width; column-- > 0;) {
      mirror.insert(mirror.end(), first + column * channels, first + (column + 1) * channels);
    }
  }
  return mirror;
}

}  // namespace

TagSearch::TagSearch(const CameraModel& camera, TagLayout layout, TagSearchOptions options)
    : camera_(camera),
      layout_(std::move(layout)),
      options_(std::move(options)),
      detector_(detectorOf(options_, camera_)) {}

/// Squares about the tags that the camera should see from where it is believed to be.
std::vector<PixelRegion> TagSearch::regions(const Eigen::Isometry3d& T_camera_world,
                                            const std::vector<Place>& also, int& expected) const {
  std::vector<PixelRegion> result;
  const auto add = [&](const Eigen::Vector2d& centre, double half) {
    const double reach = 1.25 * half + options_.margin_px;  // paper around the black square
    result.push_back({static_cast<int>(centre.x() - reach), static_cast<int>(centre.y() - reach),
                      static_cast<int>(centre.x() + reach) + 1,
                      static_cast<int>(centre.y() + reach) + 1});
  };
  const Eigen::Vector3d eye = T_camera_world.inverse().translation();
  expected = 0;
  for (const MappedTag& tag : layout_.tags) {
    const Eigen::Vector3d to_eye = eye - tag.T_world_tag.translation();
    if (tag.T_world_tag.linear().col(2).dot(to_eye.normalized()) < kSeenFromFront) continue;
    const auto centre = camera_.project(T_camera_world * tag.T_world_tag.translation());
    if (!centre) continue;
    double half = 0;
    for (const Eigen::Vector3d& p_tag : tagCorners(tag.size_m)) {
      const auto corner = camera_.project(T_camera_world * (tag.T_world_tag * p_tag));
      half = corner ? std::max(half, (*corner - *centre).cwiseAbs().maxCoeff()) : half;
    }
    const CameraInfo& info = camera_.info();
    const bool inside = centre->x() > half && centre->y() > half &&
                        centre->x() < info.width - half && centre->y() < info.height - half;
    if (inside) ++expected;
    if (centre->x() > -half && centre->y() > -half && centre->x() < info.width + half &&
        centre->y() < info.height + half) {
      add(*centre, half);
    }
  }
  for (const Place& place : also) add(place.px, place.half_px);
  return result;
}

std::vector<TagDetection> TagSearch::find(const ImageView& picture,
                                          const std::optional<Eigen::Isometry3d>& T_camera_world,
                                          const std::vector<Place>& also) {
  whole_ = !T_camera_world || ++since_whole_ >= options_.whole_every;
  std::vector<TagDetection> tags;
  if (!whole_) {
    int expected = 0;
    tags = detector_.detect(picture, regions(*T_camera_world, also, expected));
    const auto found = std::count_if(tags.begin(), tags.end(), [&](const TagDetection& tag) {
      return layout_.find(tag.id) != nullptr;
    });
    whole_ = found == 0 || 2 * found < expected;
  }
  if (whole_) {
    since_whole_ = 0;
    tags = detector_.detect(picture);
    lookIntoTheMirror(picture, !tags.empty());
  }
  return tags;
}

void TagSearch::lookIntoTheMirror(const ImageView& picture, bool found) {
  without_tags_ = found ? 0 : without_tags_ + 1;
  if (found) mirrored_ = false;
  if (without_tags_ == 0 || without_tags_ % kMirrorAfter != 0) return;
  const std::vector<std::uint8_t> mirror = mirrorImage(picture);
  const ImageView view(mirror.data(), picture.width, picture.height, picture.channels);
  mirrored_ = !detector_.detect(view).empty();
}

}  // namespace slamscope::tracking
