// SPDX-License-Identifier: MIT
#include "tracking/tag_search.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::tracking {
namespace {

constexpr double kSeenFromFront = 0.1;  // cosine to the tag's normal; more aslant it isn't expected
constexpr std::size_t kEnough = 3;  // tags of the layout, seen coarsely: no closer look is taken
constexpr int kMirrorAfter = 10;    // pictures without a tag

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

TagSearch::TagSearch(EyeCamera eye, TagLayout layout, TagSearchOptions options)
    : eye_(std::move(eye)),
      layout_(std::move(layout)),
      options_(std::move(options)),
      detector_(detectorOf(options_, eye_.model)) {}

std::vector<ExpectedTag> TagSearch::expected(const HeadMotion& head) const {
  const CameraInfo& info = eye_.model.info();
  const auto inside = [&](const Eigen::Vector2d& px) {
    return px.x() >= 0 && px.y() >= 0 && px.x() <= info.width - 1 && px.y() <= info.height - 1;
  };
  const Eigen::Vector3d camera = (head.T_world_head * eye_.T_head_camera).translation();
  std::vector<ExpectedTag> result;
  for (const MappedTag& tag : layout_.tags) {
    const Eigen::Vector3d to_camera = camera - tag.T_world_tag.translation();
    if (tag.T_world_tag.linear().col(2).dot(to_camera.normalized()) < kSeenFromFront) continue;
    ExpectedTag one{tag.id, {}};
    const auto p_tag = tagCorners(tag.size_m);
    bool whole = true;
    for (std::size_t i = 0; whole && i < 4; ++i) {
      const auto px = projectRolling(eye_, head, tag.T_world_tag * p_tag[i]);
      whole = px && inside(*px);
      if (whole) one.corners_px[i] = *px;
    }
    if (whole) result.push_back(one);
  }
  return result;
}

std::size_t TagSearch::mappedOf(const std::vector<TagDetection>& tags) const {
  return static_cast<std::size_t>(
      std::count_if(tags.begin(), tags.end(),
                    [this](const TagDetection& tag) { return layout_.find(tag.id) != nullptr; }));
}

std::vector<TagDetection> TagSearch::follow(const ImageView& picture, const HeadMotion& head,
                                            const std::vector<Place>& also, bool whole_too) {
  std::vector<PixelRegion> regions;
  for (const Place& place : also) {
    const double reach = 1.25 * place.half_px + options_.margin_px;  // paper around the square
    const Eigen::Array2i low = (place.px.array() - reach).cast<int>(),
                         high = (place.px.array() + reach).cast<int>() + 1;
    regions.push_back({low.x(), low.y(), high.x(), high.y()});
  }
  const std::vector<ExpectedTag> should_be_there = expected(head);
  std::vector<TagDetection> tags = detector_.follow(
      picture, should_be_there,
      {.margin_px = options_.margin_px, .also = regions, .whole_picture = whole_too});
  const std::size_t found = mappedOf(tags);
  if (found == 0 || 2 * found < should_be_there.size()) tags.clear();
  return tags;
}

std::vector<TagDetection> TagSearch::find(const ImageView& picture,
                                          const std::optional<HeadMotion>& head,
                                          const std::vector<Place>& also, bool closely) {
  const bool due = ++since_whole_ >= options_.whole_every;
  std::vector<TagDetection> tags;
  if (head && !(due && closely)) tags = follow(picture, *head, also, due);
  whole_ = due || tags.empty();
  if (whole_) since_whole_ = 0;
  if (!tags.empty()) {
    lookIntoTheMirror(picture, true);
    return tags;
  }
  if (!closely) tags = detector_.detectCoarsely(picture);
  if (mappedOf(tags) < std::min(kEnough, layout_.tags.size())) tags = detector_.detect(picture);
  lookIntoTheMirror(picture, !tags.empty());
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
