// SPDX-License-Identifier: MIT
#include "tracking/tag_detector.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag25h9.h>
#include <apriltag/tag36h11.h>
#include <apriltag/tagStandard41h12.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tracking/tag_corners.hpp"
#include "tracking/tag_print.hpp"

namespace slamscope::tracking {
struct TagFamily {
  const char* name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

namespace {

/// libapriltag puts the origin at the outer corner of the first pixel, OpenCV at its centre.
constexpr double kHalfPixel = 0.5;

const TagFamily& familyOf(std::string name) {
  static constexpr TagFamily kFamilies[] = {
      {"36h11", tag36h11_create, tag36h11_destroy},
      {"25h9", tag25h9_create, tag25h9_destroy},
      {"Standard41h12", tagStandard41h12_create, tagStandard41h12_destroy}};
  if (name.starts_with("tag")) name.erase(0, 3);
  for (const TagFamily& family : kFamilies) {
    if (name == family.name) return family;
  }
  if (name == "16h5") {
    throw std::invalid_argument(
        "tag family 16h5 is refused: it sees tags where there are none; use 36h11");
  }
  throw std::invalid_argument("tag family \"" + name +
                              "\" is unknown; expected 36h11, 25h9 or Standard41h12");
}

double shortestSide(const std::array<Eigen::Vector2d, 4>& corners) {
  double side = 1e9;
  for (std::size_t i = 0; i < 4; ++i) {
    side = std::min(side, (corners[i] - corners[(i + 1) % 4]).norm());
  }
  return side;
}

/// Per axis, for corner i as libapriltag gives it (measured: see
/// tests/tracking/tag_detector_test.cpp). Sides that lie too far out by as much as a blurred small
/// tag's do meet further out the sharper the corner is: seen at a grazing angle, up to 0.9 px at
/// 38 degrees.
double unrefinedSigma(const std::array<Eigen::Vector2d, 4>& corners_px, std::size_t i,
                      double decimate) {
  const Eigen::Vector2d before = (corners_px[(i + 3) % 4] - corners_px[i]).normalized();
  const Eigen::Vector2d after = (corners_px[(i + 1) % 4] - corners_px[i]).normalized();
  const double sharpness = 1 / std::max(0.05, 1 - before.dot(after));  // 1 where square
  return (shortestSide(corners_px) < 40 ? 0.10 : 0.07) * std::max(1.0, sharpness) *
         std::max(1.0, 2.5 * (decimate - 1));
}

/// Cut to the picture; those that overlap joined to their common rectangle. Ones too small to hold
/// a tag are left out.
std::vector<PixelRegion> apart(std::span<const PixelRegion> regions, int width, int height) {
  constexpr int kLeast_px = 16;
  std::vector<PixelRegion> result;
  for (PixelRegion next : regions) {
    next = {std::max(0, next.left), std::max(0, next.top), std::min(width, next.right),
            std::min(height, next.bottom)};
    if (next.right - next.left < kLeast_px || next.bottom - next.top < kLeast_px) continue;
    for (std::size_t i = 0; i < result.size();) {
      const PixelRegion& other = result[i];
      const bool overlap = next.left < other.right && other.left < next.right &&
                           next.top < other.bottom && other.top < next.bottom;
      if (!overlap) {
        ++i;
        continue;
      }
      next = {std::min(next.left, other.left), std::min(next.top, other.top),
              std::max(next.right, other.right), std::max(next.bottom, other.bottom)};
      result.erase(result.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;  // it has grown: what was apart from it may not be any more
    }
    result.push_back(next);
  }
  return result;
}

/// About a square and the paper around it.
PixelRegion regionAround(const std::array<Eigen::Vector2d, 4>& corners_px, double margin_px) {
  Eigen::Array2d low = corners_px[0], high = corners_px[0];
  for (const Eigen::Vector2d& corner : corners_px) {
    low = low.min(corner.array());
    high = high.max(corner.array());
  }
  const double reach = 0.125 * (high - low).maxCoeff() + margin_px;
  return {static_cast<int>(low.x() - reach), static_cast<int>(low.y() - reach),
          static_cast<int>(high.x() + reach) + 1, static_cast<int>(high.y() + reach) + 1};
}

PixelRegion wholeOf(const ImageView& image) {
  return {0, 0, image.width, image.height};
}

/// One and the same tag, found twice.
bool sameSquare(const TagDetection& a, const TagDetection& b) {
  return a.id == b.id && (a.corners_px[0] - b.corners_px[0]).norm() < 5 &&
         (a.corners_px[2] - b.corners_px[2]).norm() < 5;
}

void sortById(std::vector<TagDetection>& tags) {
  std::stable_sort(tags.begin(), tags.end(),
                   [](const TagDetection& a, const TagDetection& b) { return a.id < b.id; });
}

}  // namespace

std::array<Eigen::Vector3d, 4> tagCorners(double size_m) {
  const double h = size_m / 2;
  return {Eigen::Vector3d(-h, -h, 0), Eigen::Vector3d(h, -h, 0), Eigen::Vector3d(h, h, 0),
          Eigen::Vector3d(-h, h, 0)};
}

struct TagDetector::Impl {
  explicit Impl(TagDetectorOptions given)
      : options(std::move(given)),
        kind(familyOf(options.family)),
        family(kind.create()),
        detector(apriltag_detector_create()) {
    apriltag_detector_add_family_bits(detector, family, options.max_hamming);
    detector->nthreads = std::max(1, options.threads);
  }
  ~Impl() {
    apriltag_detector_destroy(detector);
    kind.destroy(family);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  ImageView toGrey(const ImageView& image);
  /// Tags of one part of the picture (grey), in the whole picture's pixels.
  void search(const ImageView& grey, const PixelRegion& region, std::vector<TagDetection>& tags);
  /// Tags of several; `coarser`: than the options say.
  void search(const ImageView& grey, std::span<const PixelRegion> regions, double coarser,
              std::vector<TagDetection>& tags);
  TagDetection convert(const apriltag_detection_t& found, const ImageView& grey,
                       const Eigen::Vector2d& offset) const;
  /// The tag where it is expected; nothing where it isn't, or isn't that tag.
  std::optional<TagDetection> followOne(const ImageView& grey, const ExpectedTag& expected);
  [[nodiscard]] std::optional<RefinedCorners> refined(
      const ImageView& grey, const std::array<Eigen::Vector2d, 4>& corners_px) const;
  const TagCells& printOf(int id);

  TagDetectorOptions options;
  const TagFamily& kind;
  apriltag_family_t* family;
  apriltag_detector_t* detector;
  cv::Mat grey_picture;
  std::map<int, TagCells> prints;  // of tags followed so far
};

ImageView TagDetector::Impl::toGrey(const ImageView& image) {
  const bool usable = image.pixels && image.width > 0 && image.height > 0 &&
                      (image.channels == 1 || image.channels == 3);
  if (!usable) {
    throw std::invalid_argument("picture to detect tags in: " + std::to_string(image.width) +
                                " x " + std::to_string(image.height) + ", " +
                                std::to_string(image.channels) + " channels");
  }
  if (image.channels == 1) return image;
  const cv::Mat colour(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels),
                       image.row_bytes);
  cv::cvtColor(colour, grey_picture, cv::COLOR_BGR2GRAY);
  ImageView grey(grey_picture.data, image.width, image.height, 1);
  grey.row_bytes = grey_picture.step;
  return grey;
}

TagDetection TagDetector::Impl::convert(const apriltag_detection_t& found, const ImageView& grey,
                                        const Eigen::Vector2d& offset) const {
  TagDetection tag;
  tag.id = found.id;
  tag.margin = found.decision_margin;
  tag.hamming = found.hamming;
  for (std::size_t i = 0; i < 4; ++i) {
    tag.corners_px[i] = offset.array() + Eigen::Array2d(found.p[i][0], found.p[i][1]) - kHalfPixel;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    tag.sigma_px[i] = unrefinedSigma(tag.corners_px, i, detector->quad_decimate);
  }
  if (const auto better = refined(grey, tag.corners_px)) {
    tag.corners_px = better->px;
    tag.sigma_px = better->sigma_px;
    tag.refined = true;
  }
  return tag;
}

std::optional<RefinedCorners> TagDetector::Impl::refined(
    const ImageView& grey, const std::array<Eigen::Vector2d, 4>& corners_px) const {
  if (!options.refine) return std::nullopt;
  CornerRefinement refinement;
  refinement.cells = family->width_at_border;
  refinement.camera = options.camera ? &*options.camera : nullptr;
  return refineCorners(grey, corners_px, refinement);
}

const TagCells& TagDetector::Impl::printOf(int id) {
  const auto known = prints.find(id);
  if (known != prints.end()) return known->second;
  return prints.emplace(id, tagCells(options.family, id)).first->second;
}

std::optional<TagDetection> TagDetector::Impl::followOne(const ImageView& grey,
                                                         const ExpectedTag& expected) {
  const auto corners = refined(grey, expected.corners_px);
  if (!corners) return std::nullopt;
  const PrintMatch match = comparePrint(grey, corners->px, printOf(expected.id));
  if (!match.whole_edge || match.wrong > options.max_hamming || match.margin < options.min_margin) {
    return std::nullopt;
  }
  return TagDetection{.id = expected.id,
                      .corners_px = corners->px,
                      .sigma_px = corners->sigma_px,
                      .margin = match.margin,
                      .hamming = match.wrong,
                      .refined = true};
}

TagDetector::TagDetector(TagDetectorOptions options)
    : impl_(std::make_unique<Impl>(std::move(options))) {}
TagDetector::~TagDetector() = default;
TagDetector::TagDetector(TagDetector&&) noexcept = default;
TagDetector& TagDetector::operator=(TagDetector&&) noexcept = default;

void TagDetector::Impl::search(const ImageView& grey, const PixelRegion& region,
                               std::vector<TagDetection>& tags) {
  const std::size_t first =
      static_cast<std::size_t>(region.top) * grey.row_bytes + static_cast<std::size_t>(region.left);
  image_u8_t input{region.right - region.left, region.bottom - region.top,
                   static_cast<int>(grey.row_bytes),
                   const_cast<std::uint8_t*>(grey.pixels) + first};
  zarray_t* found = apriltag_detector_detect(detector, &input);
  for (int i = 0; i < zarray_size(found); ++i) {
    apriltag_detection_t* one = nullptr;
    zarray_get(found, i, &one);
    if (one->decision_margin < options.min_margin) continue;
    TagDetection tag = convert(*one, grey, {region.left, region.top});
    // The edge of the picture makes a side of its own of a tag that it cuts.
    if (comparePrint(grey, tag.corners_px, printOf(tag.id)).in_picture) {
      tags.push_back(std::move(tag));
    }
  }
  apriltag_detections_destroy(found);
}

void TagDetector::Impl::search(const ImageView& grey, std::span<const PixelRegion> regions,
                               double coarser, std::vector<TagDetection>& tags) {
  const double automatic = grey.width >= 1280 ? 2 : 1;
  detector->quad_decimate = static_cast<float>(coarser * options.quad_decimate.value_or(automatic));
  for (const PixelRegion& region : apart(regions, grey.width, grey.height)) {
    search(grey, region, tags);
  }
}

std::vector<TagDetection> TagDetector::detect(const ImageView& image) {
  const PixelRegion whole = wholeOf(image);
  return detect(image, std::span(&whole, 1));
}

std::vector<TagDetection> TagDetector::detect(const ImageView& image,
                                              std::span<const PixelRegion> regions) {
  std::vector<TagDetection> tags;
  impl_->search(impl_->toGrey(image), regions, 1, tags);
  sortById(tags);
  return tags;
}

std::vector<TagDetection> TagDetector::detectCoarsely(const ImageView& image) {
  return follow(image, {}, {.whole_picture = true});
}

std::vector<TagDetection> TagDetector::follow(const ImageView& image,
                                              std::span<const ExpectedTag> expected,
                                              const FollowOptions& how) {
  const ImageView grey = impl_->toGrey(image);
  std::vector<TagDetection> tags, searched;
  std::vector<PixelRegion> regions(how.also.begin(), how.also.end());
  for (const ExpectedTag& one : expected) {
    if (auto tag = impl_->followOne(grey, one)) {
      tags.push_back(std::move(*tag));
    } else {
      regions.push_back(regionAround(one.corners_px, how.margin_px));
    }
  }
  impl_->search(grey, regions, 1, searched);
  const PixelRegion whole = wholeOf(image);
  if (how.whole_picture) impl_->search(grey, std::span(&whole, 1), 2, searched);
  for (TagDetection& tag : searched) {
    const bool known = std::any_of(tags.begin(), tags.end(),
                                   [&](const auto& one) { return sameSquare(one, tag); });
    if (!known) tags.push_back(std::move(tag));
  }
  sortById(tags);
  return tags;
}

}  // namespace slamscope::tracking
