// SPDX-License-Identifier: MIT
#include "tracking/tag_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "rendered_tag.hpp"
#include "tracking/tag_cells.hpp"
#include "tracking/tag_print.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;
using testing::Picture, testing::PrintedTag, testing::render, testing::Rendering;
using Corners = std::array<Vector2d, 4>;

/// Corners (order of tagCorners) of a tag near the middle of a picture 1.5 side + 40 wide, turned
/// and tilted.
Corners someCorners(double side, bool aligned, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  const double middle = std::round(0.75 * side + 20);
  const Vector2d centre(middle + any(random), middle + any(random));
  const Eigen::Rotation2Dd turn(aligned ? 0 : 2 * M_PI * any(random));
  const auto p_tag = tagCorners(side);
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d tilt =
        aligned ? Vector2d(0, 0) : side * 0.08 * Vector2d(any(random), any(random));
    corners[i] = centre + turn * Vector2d(p_tag[i].x() + tilt.x(), -p_tag[i].y() + tilt.y());
  }
  return corners;
}

Rendering through(const Corners& corners) {
  Rendering rendering;
  const Eigen::Matrix3d H = testing::squareToPixels(corners).inverse();
  rendering.tag_of_pixel = [H](const Vector2d& px) {
    const Vector3d q = H * px.homogeneous();
    return Vector2d(q.x() / q.z(), q.y() / q.z());
  };
  return rendering;
}

ImageView view(const Picture& picture) {
  return {picture.grey.data(), picture.width, picture.height, 1};
}

struct CornerErrors {
  double rms = 0, nees = 0;  // per axis
  Vector2d bias = Vector2d::Zero();
  int missed = 0, unrefined = 0;
};

/// Corners of a tag turned by 45 degrees or so and seen at a grazing angle: a flat diamond.
Corners diamond(double side, std::mt19937& random) {
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  const Vector2d centre(std::round(0.75 * side + 20) + any(random), 0.75 * side + 20);
  const Eigen::Rotation2Dd turn(M_PI / 4 + 0.2 * any(random));
  const auto p_tag = tagCorners(side);
  Corners corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d turned = turn * Vector2d(p_tag[i].x(), -p_tag[i].y());
    corners[i] = centre + Vector2d(turned.x(), 0.45 * turned.y());
  }
  return corners;
}

/// `offset`: what is done to the corners found before they are compared.
CornerErrors measure(double side, double blur, const TagDetectorOptions& options,
                     const Vector2d& offset = {0, 0}) {
  std::mt19937 random(7);
  TagDetector detector(options);
  CornerErrors errors;
  constexpr int kTags = 8;
  int corners = 0;
  for (int k = 0; k < kTags; ++k) {
    const Corners truth = someCorners(side, k < 3, random);
    Rendering rendering = through(truth);
    rendering.width = rendering.height = int(1.5 * side + 40);
    rendering.blur_px = blur;
    rendering.seed = unsigned(k) + 1;
    const auto tags = detector.detect(view(render(PrintedTag(k), rendering)));
    if (tags.size() != 1 || tags[0].id != k) {
      ++errors.missed;
      continue;
    }
    errors.unrefined += tags[0].refined ? 0 : 1;
    for (std::size_t i = 0; i < 4; ++i, ++corners) {
      const Vector2d e = tags[0].corners_px[i] + offset - truth[i];
      errors.rms += e.squaredNorm() / 2;
      errors.nees += e.squaredNorm() / 2 / std::pow(tags[0].sigma_px[i], 2);
      errors.bias += e;
    }
  }
  errors.rms = std::sqrt(errors.rms / corners);
  errors.nees /= corners;
  errors.bias /= corners;
  return errors;
}

/// Figure T2 of the specification.
bool meetsT2(const CornerErrors& errors) {
  return errors.missed == 0 && errors.rms <= 0.02 && errors.bias.cwiseAbs().maxCoeff() <= 0.005;
}

TEST(TagDetector, CornersAreWithinFiftiethOfAPixel) {
  for (const double side : {40.0, 80.0, 120.0}) {
    for (const double blur : {0.0, 0.3, 0.6}) {
      const CornerErrors errors = measure(side, blur, {});
      EXPECT_TRUE(meetsT2(errors))
          << side << " px, blur " << blur << ": rms " << errors.rms << ", bias "
          << errors.bias.transpose() << ", missed " << errors.missed;
      EXPECT_EQ(errors.unrefined, 0);
      EXPECT_LT(errors.nees, 1.6) << "sigma_px promises too much";
      EXPECT_GT(errors.nees, 0.15) << "sigma_px promises too little";
    }
  }
}

TEST(TagDetector, HalfAPixelWouldBeSeen) {
  EXPECT_FALSE(meetsT2(measure(80, 0.6, {}, {0.5, 0.5})));
  EXPECT_FALSE(meetsT2(measure(80, 0.6, {}, {0.02, 0})));
}

TEST(TagDetector, WithoutRefinementTheFigureIsMissed) {
  TagDetectorOptions options;
  options.refine = false;
  EXPECT_FALSE(meetsT2(measure(80, 0.6, options)));
}

/// Tag 7 with sides of 60 px, and where it truly is.
struct SeenTag {
  Picture picture;
  Corners truth;
};

SeenTag seenTag() {
  std::mt19937 random(11);
  const Corners truth = someCorners(60, false, random);
  Rendering rendering = through(truth);
  rendering.width = rendering.height = 130;
  rendering.blur_px = 0.5;
  return {render(PrintedTag(7), rendering), truth};
}

ExpectedTag expectedAt(int id, const Corners& corners, const Vector2d& off) {
  ExpectedTag expected{id, corners};
  for (Vector2d& corner : expected.corners_px) corner += off;
  return expected;
}

double worstCorner(const TagDetection& tag, const Corners& truth) {
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    worst = std::max(worst, (tag.corners_px[i] - truth[i]).norm());
  }
  return worst;
}

TEST(TagDetector, FollowedTagsHaveTheCornersOfSearchedOnes) {
  const auto [picture, truth] = seenTag();
  TagDetector detector;
  for (const Vector2d& off : {Vector2d(0, 0), Vector2d(1.2, -0.9), Vector2d(9, 4)}) {
    const ExpectedTag expected = expectedAt(7, truth, off);
    const auto tags = detector.follow(view(picture), std::span(&expected, 1));
    ASSERT_EQ(tags.size(), 1U) << off.transpose();
    EXPECT_LT(worstCorner(tags[0], truth), 0.05) << off.transpose();
    EXPECT_EQ(tags[0].hamming, 0);
    const bool searched = off.norm() > 3;
    EXPECT_NEAR(tags[0].margin, searched ? 171 : 95, 1) << "half the contrast of the print";
  }
  const ExpectedTag far = expectedAt(7, truth, {60, 60});
  EXPECT_TRUE(
      detector.follow(view(picture), std::span(&far, 1), {.margin_px = 2, .also = {}}).empty());
}

TEST(TagDetector, ACoveredEdgeAndTheEdgeOfThePictureAreSeenInThePrint) {
  const auto [picture, truth] = seenTag();
  const TagCells print = tagCells("36h11", 7);
  const PrintMatch whole = comparePrint(view(picture), truth, print);
  EXPECT_EQ(whole.wrong, 0);
  EXPECT_TRUE(whole.whole_edge);
  Picture covered = picture;  // a white spot in the middle of the upper side
  const Vector2d middle = (truth[3] + truth[2]) / 2;
  for (int row = -4; row <= 4; ++row) {
    for (int column = -4; column <= 4; ++column) {
      const auto y = static_cast<std::size_t>(std::lround(middle.y()) + row);
      const auto x = static_cast<std::size_t>(std::lround(middle.x()) + column);
      covered.grey[y * static_cast<std::size_t>(covered.width) + x] = 250;
    }
  }
  const PrintMatch spot = comparePrint(view(covered), truth, print);
  EXPECT_LE(spot.wrong, 2) << "or it is too much for the code anyway";
  EXPECT_FALSE(spot.whole_edge);
  ImageView cut = view(picture);
  cut.width = static_cast<int>(std::max(truth[1].x(), truth[2].x()));
  EXPECT_FALSE(comparePrint(cut, truth, print).in_picture);
}

TEST(TagDetector, ATagThatThePictureCutsIsNotTakenForAWholeOne) {
  const auto [picture, truth] = seenTag();
  double right = 0;
  for (const Vector2d& corner : truth) right = std::max(right, corner.x());
  TagDetector detector;
  for (const double cut_px : {-12.0, -3.0, 0.0, 2.0}) {
    ImageView cut = view(picture);
    cut.width = static_cast<int>(right + cut_px);
    const ExpectedTag expected = expectedAt(7, truth, {0, 0});
    EXPECT_TRUE(detector.detect(cut).empty()) << cut_px;
    EXPECT_TRUE(detector.follow(cut, std::span(&expected, 1)).empty()) << cut_px;
  }
  EXPECT_EQ(detector.detect(view(picture)).size(), 1U);
}

TEST(TagDetector, AnotherTagInTheExpectedPlaceIsSeenForWhatItIs) {
  const auto [picture, truth] = seenTag();
  TagDetector detector;
  const ExpectedTag other = expectedAt(8, truth, {0, 0});
  const auto tags = detector.follow(view(picture), std::span(&other, 1));
  ASSERT_EQ(tags.size(), 1U);
  EXPECT_EQ(tags[0].id, 7);
  ExpectedTag turned = expectedAt(7, truth, {0, 0});
  std::rotate(turned.corners_px.begin(), turned.corners_px.begin() + 1, turned.corners_px.end());
  const auto found = detector.follow(view(picture), std::span(&turned, 1));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(worstCorner(found[0], truth), 0.05) << "a quarter of a turn isn't believed";
}

TEST(TagDetector, FollowedTagsAreNotFoundOnceMoreWhereTheSearchMeetsThem) {
  const auto [picture, truth] = seenTag();
  TagDetector detector;
  const ExpectedTag expected = expectedAt(7, truth, {0.5, 0.5});
  const PixelRegion whole{0, 0, picture.width, picture.height};
  const auto tags = detector.follow(view(picture), std::span(&expected, 1),
                                    {.also = std::span(&whole, 1), .whole_picture = true});
  EXPECT_EQ(tags.size(), 1U);
}

TEST(TagDetector, SearchingAtHalfSizeChangesNoCorner) {
  TagDetectorOptions options;
  options.quad_decimate = 2;
  EXPECT_TRUE(meetsT2(measure(60, 0.5, options)));
}

TEST(TagDetector, SmallTagsAreStillFoundAndTheirSigmaSaysSo) {
  const CornerErrors errors = measure(18, 0.5, {});
  EXPECT_EQ(errors.missed, 0);
  EXPECT_EQ(errors.unrefined, 8);
  EXPECT_LT(errors.nees, 2.5);
}

TEST(TagDetector, SharpCornersOfSmallTagsAreKnownToBeWorse) {
  std::mt19937 random(3);
  TagDetector detector;
  double sharp_chi2 = 0;  // 2.6 with a sigma that knows nothing of sharpness
  constexpr int kTags = 40;
  for (int k = 0; k < kTags; ++k) {
    const Corners truth = diamond(22, random);
    Rendering rendering = through(truth);
    rendering.width = rendering.height = 73;
    rendering.blur_px = 0.5;
    rendering.seed = unsigned(k) + 1;
    const auto tags = detector.detect(view(render(PrintedTag(k % 8), rendering)));
    ASSERT_EQ(tags.size(), 1U);
    ASSERT_FALSE(tags[0].refined);
    for (std::size_t i = 0; i < 4; ++i) {
      const double e2 = (tags[0].corners_px[i] - truth[i]).squaredNorm() / 2;
      const double sigma = tags[0].sigma_px[i];
      EXPECT_LT(std::sqrt(2 * e2), 6 * sigma) << "the tracker would leave it out";
      const bool sharp = std::abs(truth[i].x() - truth[(i + 2) % 4].x()) > 15;
      if (sharp) sharp_chi2 += e2 / (sigma * sigma) / (2 * kTags);
    }
  }
  EXPECT_LT(sharp_chi2, 1.6);
  EXPECT_GT(sharp_chi2, 0.15);
}

TEST(TagDetector, FirstCornerIsTheLowerLeftOfTheUprightTag) {
  const Corners upright{Vector2d(60, 140), {140, 140}, {140, 60}, {60, 60}};
  const auto tags = TagDetector().detect(view(render(PrintedTag(5), through(upright))));
  ASSERT_EQ(tags.size(), 1U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((tags[0].corners_px[i] - upright[i]).norm(), 0.05);
  const auto p_tag = tagCorners(2);
  EXPECT_EQ(p_tag[0], Vector3d(-1, -1, 0));
  EXPECT_EQ(p_tag[2], Vector3d(1, 1, 0));
}

TEST(TagDetector, MirroredTagIsNoTag) {
  const Corners mirrored{Vector2d(140, 140), {60, 140}, {60, 60}, {140, 60}};
  EXPECT_TRUE(TagDetector().detect(view(render(PrintedTag(5), through(mirrored)))).empty());
}

TEST(TagDetector, SidesMayBowUnderAKnownLens) {
  CameraInfo info;
  info.width = info.height = 200;
  info.K << 120, 0, 99.5, 0, 120, 99.5, 0, 0, 1;
  info.D = {-0.25, 0.05, 0, 0};
  const CameraModel camera(info);
  const Corners straight{Vector2d(120, 195), {205, 190}, {200, 110}, {115, 115}};  // undistorted
  const Eigen::Matrix3d H = testing::squareToPixels(straight).inverse();
  Rendering rendering;
  rendering.tag_of_pixel = [&](const Vector2d& px) {
    const auto ray = camera.unproject(px);
    if (!ray) return Vector2d(9, 9);
    const Vector3d q = H * info.K * *ray;
    return Vector2d(q.x() / q.z(), q.y() / q.z());
  };
  const Picture picture = render(PrintedTag(3), rendering);
  const auto worst = [&](const TagDetectorOptions& options) {
    const auto tags = TagDetector(options).detect(view(picture));
    double error = tags.size() == 1 ? 0 : 1e9;
    for (std::size_t i = 0; i < 4 && error < 1e9; ++i) {
      const Vector3d ray = info.K.inverse() * straight[i].homogeneous();
      error = std::max(error, (tags[0].corners_px[i] - *camera.project(ray)).norm());
    }
    return error;
  };
  TagDetectorOptions options;
  EXPECT_GT(worst(options), 0.2) << "without the lens, straight lines can't fit";
  options.camera = camera;
  EXPECT_LT(worst(options), 0.03);
}

TEST(TagDetector, ColourAndGreyAgree) {
  std::mt19937 random(3);
  const Picture picture = render(PrintedTag(9), through(someCorners(70, false, random)));
  Frame frame;
  frame.width = picture.width;
  frame.height = picture.height;
  for (const std::uint8_t grey : picture.grey) frame.bgr.insert(frame.bgr.end(), 3, grey);
  TagDetector detector;
  const auto grey = detector.detect(view(picture)), colour = detector.detect(frame);
  ASSERT_EQ(grey.size(), 1U);
  ASSERT_EQ(colour.size(), 1U);
  EXPECT_EQ(grey[0].corners_px, colour[0].corners_px);
}

TEST(TagDetector, NoiseAloneHoldsNoTag) {
  std::mt19937 random(4);
  std::vector<std::uint8_t> noise(320 * 240);
  for (auto& pixel : noise) pixel = std::uint8_t(random());
  EXPECT_TRUE(TagDetector().detect({noise.data(), 320, 240, 1}).empty());
}

TEST(TagDetector, RefusesTheFamilyThatSeesTagsEverywhere) {
  EXPECT_NO_THROW(TagDetector({.family = "tag25h9"}));
  EXPECT_NO_THROW(TagDetector({.family = "Standard41h12"}));
  try {
    TagDetector detector({.family = "tag16h5"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("16h5 is refused"), std::string::npos);
  }
  EXPECT_THROW(TagDetector({.family = "36h12"}), std::invalid_argument);
}

TEST(TagDetector, RefusesAnEmptyPicture) {
  EXPECT_THROW(static_cast<void>(TagDetector().detect({nullptr, 0, 0, 1})), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::tracking
