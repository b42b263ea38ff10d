// SPDX-License-Identifier: MIT
#include "tracking/lab.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <set>

#include "tracking/lab_lens.hpp"

namespace slamscope::tracking {
namespace {

using namespace std::chrono_literals;

/// A small camera over the middle of the lab: quick to render.
LabOptions smallLab() {
  LabOptions options = defaultLab();
  options.camera.width = 320;
  options.camera.height = 240;
  options.camera.K << 200, 0, 161.3, 0, 200, 117.6, 0, 0, 1;
  options.posts = {{1, {0.9, 0.6}}, {2, {0.5, -0.8}}};
  options.robot_pose_map = [](std::chrono::nanoseconds time) {
    const double s = std::chrono::duration<double>(time).count();
    return Eigen::Vector3d(0.3 * s, 0.1 * s, 0.5 * s);
  };
  return options;
}

/// Light without noise nor vignette, so that edges can be measured.
LabOptions cleanLab() {
  LabOptions options = defaultLab();
  options.noise = 0;
  options.vignette = 0;
  return options;
}

/// By cv::projectPoints, the way back of what the lab's rays take.
std::vector<Eigen::Vector2d> project(const CameraInfo& camera,
                                     const Eigen::Isometry3d& T_world_camera,
                                     const std::vector<Eigen::Vector3d>& p_world) {
  std::vector<Eigen::Vector3d> p_camera;
  for (const Eigen::Vector3d& p : p_world) p_camera.push_back(T_world_camera.inverse() * p);
  return lab::projectByOpenCv(camera, p_camera);
}

double grey(const Frame& frame, int column, int row) {
  const std::uint8_t* p = &frame.bgr[3 * (static_cast<std::size_t>(row) * frame.width + column)];
  return 0.114 * p[0] + 0.587 * p[1] + 0.299 * p[2];
}

double greyAt(const Frame& frame, Eigen::Vector2d p) {
  const int column = static_cast<int>(std::floor(p.x())), row = static_cast<int>(std::floor(p.y()));
  const double fx = p.x() - column, fy = p.y() - row;
  return (1 - fy) * ((1 - fx) * grey(frame, column, row) + fx * grey(frame, column + 1, row)) +
         fy * ((1 - fx) * grey(frame, column, row + 1) + fx * grey(frame, column + 1, row + 1));
}

/// How far the black edge at `p` lies from where it should, along `outward`, px: from the light
/// that is missing between plateaus 2.4 px to either side (area under the profile, so blur does not
/// matter).
double edgeOffset(const Frame& frame, Eigen::Vector2d p, Eigen::Vector2d outward) {
  constexpr int kSteps = 96;
  constexpr double kHalf = 2.4;
  std::vector<double> profile;
  for (int i = 0; i <= kSteps; ++i)
    profile.push_back(greyAt(frame, p + outward * (kHalf * (2.0 * i / kSteps - 1))));
  const double black = profile.front(), white = profile.back();
  double bright = 0;
  for (int i = 0; i < kSteps; ++i) bright += (profile[i] + profile[i + 1]) / 2 - black;
  return kHalf - bright / (white - black) * (2 * kHalf / kSteps);
}

struct Misplaced {
  double worst_side_px = 0, rms_px = 0;
};

/// A place on one side of a tag, `outward` in half sides from it.
Eigen::Vector3d onSide(const LabTag& tag, int side, double along, double outward) {
  constexpr std::array<double, 5> kX = {-1, 1, 1, -1, -1}, kY = {-1, -1, 1, 1, -1};
  const double dx = (kX[side + 1] - kX[side]) / 2, dy = (kY[side + 1] - kY[side]) / 2;
  const double x = kX[side] + 2 * dx * along + dy * outward;
  const double y = kY[side] + 2 * dy * along - dx * outward;
  return tag.T_world_tag * (Eigen::Vector3d(x, y, 0) * tag.size / 2);
}

/// Mean distance of a side's black edge from where `camera` projects it, px, outward.
double sideOffset(const Frame& frame, const LabOptions& options, const CameraInfo& camera,
                  const LabTag& tag, int side) {
  constexpr int kPoints = 60;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double along = 0.12 + 0.76 * (i + 0.5) / kPoints;
    const auto p = project(camera, options.T_world_camera,
                           {onSide(tag, side, along, 0), onSide(tag, side, along - 0.01, 0),
                            onSide(tag, side, along + 0.01, 0), onSide(tag, side, along, 0.01)});
    const Eigen::Vector2d tangent = (p[2] - p[1]).normalized();
    Eigen::Vector2d normal(tangent.y(), -tangent.x());
    if (normal.dot(p[3] - p[0]) < 0) normal = -normal;
    sum += edgeOffset(frame, p[0], normal);
  }
  return sum / kPoints;
}

/// Measures the sides of tags in a frame against the projection of the same tags by `camera`.
Misplaced measured(const Frame& frame, const LabOptions& options, const CameraInfo& camera,
                   const std::vector<LabTag>& tags) {
  Misplaced result;
  for (const LabTag& tag : tags)
    for (int side = 0; side < 4; ++side) {
      const double offset = sideOffset(frame, options, camera, tag, side);
      result.worst_side_px = std::max(result.worst_side_px, std::abs(offset));
      result.rms_px += offset * offset / (4 * static_cast<double>(tags.size()));
    }
  result.rms_px = std::sqrt(result.rms_px);
  return result;
}

LabTag robotTag(const LabOptions& options) {
  return {options.robot_tag_id, options.robot_tag_size, options.T_world_map * options.T_robot_tag};
}

TEST(Lab, TagEdgesLieWhereOpenCvProjectsThem) {
  LabOptions options = cleanLab();
  options.T_world_map = Eigen::Translation3d(0.3, -0.2, 0) *
                        Eigen::Isometry3d(Eigen::AngleAxisd(0.37, Eigen::Vector3d::UnitZ()));
  const Lab lab(options);
  const Frame frame = lab.frame(0);
  std::vector<LabTag> tags = options.tags;
  tags.push_back(robotTag(options));
  const Misplaced misplaced = measured(frame, options, options.camera, tags);
  EXPECT_LT(misplaced.rms_px, 0.006);
  EXPECT_LT(misplaced.worst_side_px, 0.015);

  // Must fail: half a pixel between the pixel conventions.
  CameraInfo shifted = options.camera;
  shifted.K(0, 2) += 0.5;
  shifted.K(1, 2) += 0.5;
  EXPECT_GT(measured(frame, options, shifted, tags).rms_px, 0.3);
  // Must fail: a hundredth less of lens distortion.
  CameraInfo weak = options.camera;
  weak.D[0] += 0.001;
  EXPECT_GT(measured(frame, options, weak, options.tags).rms_px, 0.02);
}

TEST(Lab, TagEdgesAlongPixelRowsAreNoWorse) {
  // The hardest case for a grid of samples: every point of an edge at the same place in its pixel.
  LabOptions options = cleanLab();
  options.camera.D.clear();
  options.camera.K(0, 2) = 640.17;
  options.camera.K(1, 2) = 359.71;
  options.T_world_camera = Eigen::Translation3d(0, 0, 3) *
                           Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  options.tags.clear();
  for (int i = 0; i < 4; ++i)
    options.tags.push_back({.id = 100 + i,
                            .size = 0.20,
                            .T_world_tag = Eigen::Isometry3d(Eigen::Translation3d(
                                -2.0003 + 0.5011 * i, 0.4307 - 0.3017 * i, 0))});
  const Lab lab(options);
  const Misplaced misplaced = measured(lab.frame(0), options, options.camera, options.tags);
  EXPECT_LT(misplaced.worst_side_px, 0.012);
}

TEST(Lab, EdgesAreTrueWithOtherLenses) {
  LabOptions options = cleanLab();
  for (LabTag& tag : options.tags) tag.size = 0.30;  // these lenses squeeze the outer ones
  options.camera.model = DistortionModel::rational_polynomial;
  options.camera.D = {0.35, -0.05, 0.0004, 0.0003, 0.01, 0.55, -0.02, 0.012};
  const Lab rational(options);
  EXPECT_LT(measured(rational.frame(0), options, options.camera, options.tags).worst_side_px,
            0.015);

  options.camera.model = DistortionModel::equidistant;
  options.camera.D = {-0.03, 0.004, -0.001, 0.0002};
  options.tags = {options.tags[1], options.tags[7]};
  const Lab fisheye(options);
  EXPECT_LT(measured(fisheye.frame(0), options, options.camera, options.tags).worst_side_px, 0.015);
}

/// Grey-weighted middle of the dark disc at a post's foot.
Eigen::Vector2d darkCentre(const Frame& frame, const Frame& without, Eigen::Vector2d about,
                           double radius) {
  double weight = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int row = static_cast<int>(about.y() - radius); row <= about.y() + radius; ++row)
    for (int column = static_cast<int>(about.x() - radius); column <= about.x() + radius;
         ++column) {
      if (std::hypot(column - about.x(), row - about.y()) > radius) continue;
      const double before = grey(without, column, row);
      const double covered = std::max(0.0, (before - grey(frame, column, row)) / before - 0.35);
      weight += covered;
      sum += covered * Eigen::Vector2d(column, row);
    }
  return sum / weight;
}

TEST(Lab, PostsStandOnTheirFeatures) {
  // Posts so low and wide that what is seen of them is a disc, level with the floor but for 6 mm.
  LabOptions options = cleanLab();
  options.post_radius = 0.03;
  options.post_height = 0.006;
  options.T_world_map = Eigen::Translation3d(-0.4, 0.2, 0) *
                        Eigen::Isometry3d(Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()));
  const Frame without = Lab(options).frame(0);
  options.posts = {{7, {1.1, 0.4}}, {8, {-0.6, 0.9}}, {9, {0.2, -1.1}}};
  const Frame with = Lab(options).frame(0);
  for (const LabPost& post : options.posts) {
    const Eigen::Vector3d base =
        options.T_world_map * Eigen::Vector3d(post.p_map.x(), post.p_map.y(), 0);
    const Eigen::Vector2d expected =
        project(options.camera, options.T_world_camera, {base}).front();
    const Eigen::Vector2d seen = darkCentre(with, without, expected, 22);
    EXPECT_LT((seen - expected).norm(), 0.8) << post.id;
    // Must fail: the same post looked for 1 cm beside.
    const Eigen::Vector3d beside = base + Eigen::Vector3d(0.01, 0, 0);
    const Eigen::Vector2d wrong = project(options.camera, options.T_world_camera, {beside}).front();
    EXPECT_GT((seen - wrong).norm(), 1.2) << post.id;
  }
}

TEST(Lab, SameOptionsGiveTheSameBytesInAnyOrder) {
  LabOptions options = smallLab();
  options.rest_frames = 2;
  Lab first(options);
  const Lab second(options);
  std::vector<Frame> in_order;
  for (int k = 0; k < 5; ++k) in_order.push_back(*first.next());
  for (const std::uint64_t k : {4U, 0U, 3U, 1U, 2U, 1U})
    EXPECT_EQ(second.frame(k).bgr, in_order[k].bgr) << k;

  options.seed = 2;
  EXPECT_NE(Lab(options).frame(0).bgr, in_order[0].bgr);
  EXPECT_NE(in_order[0].bgr, in_order[1].bgr) << "noise must differ from frame to frame";
}

TEST(Lab, NoiseHasTheStandardDeviationAskedFor) {
  LabOptions options = smallLab();
  const Lab noisy(options);
  options.noise = 0;
  const Frame clean = Lab(options).frame(0);
  double sum = 0, squares = 0, between = 0;
  const Frame a = noisy.frame(0), b = noisy.frame(1);
  const int pixels = a.width * a.height;
  for (int row = 0; row < a.height; ++row)
    for (int column = 0; column < a.width; ++column) {
      const double da = grey(a, column, row) - grey(clean, column, row);
      const double db = grey(b, column, row) - grey(clean, column, row);
      sum += da;
      squares += da * da;
      between += da * db;
    }
  EXPECT_NEAR(sum / pixels, 0, 0.05);
  EXPECT_NEAR(std::sqrt(squares / pixels), 2.0, 0.1);
  EXPECT_NEAR(between / squares, 0, 0.02) << "noise of two frames must not be alike";
}

TEST(Lab, RestsThenShowsTheRunAtItsStartPlusFrameTime) {
  LabOptions options = smallLab();
  options.start = 10s;
  options.fps = 25;
  options.frames = 40;
  std::vector<std::chrono::nanoseconds> asked;
  options.robot_pose_map = [&](std::chrono::nanoseconds time) {
    asked.push_back(time);
    return Eigen::Vector3d(1e-9 * static_cast<double>((time - 10s).count()), 0, 0);
  };
  const Lab lab(options);
  EXPECT_EQ(lab.count(), 40U);
  EXPECT_EQ(lab.time(3), 10s + 120ms);
  EXPECT_EQ(lab.robotPoseMap(29).x(), 0);
  EXPECT_NEAR(lab.robotPoseMap(30).x(), 30 / 25.0, 1e-9);
  asked.clear();
  EXPECT_EQ(lab.frame(30).time, 10s + 1200ms);
  const auto [first, last] = std::minmax_element(asked.begin(), asked.end());
  EXPECT_EQ(*first, 10s + 1200ms - options.exposure / 2);
  EXPECT_EQ(*last, 10s + 1200ms + options.exposure / 2);
}

TEST(Lab, EndsAfterItsFrames) {
  LabOptions options = smallLab();
  options.frames = 2;
  Lab lab(options);
  EXPECT_EQ(lab.next()->sequence, 0U);
  EXPECT_EQ(lab.next()->sequence, 1U);
  EXPECT_FALSE(lab.next());
  EXPECT_TRUE(lab.stamped());
  EXPECT_FALSE(lab.live());
  EXPECT_EQ(lab.cameraInfo()->K, options.camera.K);
}

/// Mean brightness difference between two frames, per row of the picture.
double difference(const Frame& a, const Frame& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.bgr.size(); ++i) sum += std::abs(int{a.bgr[i]} - int{b.bgr[i]});
  return sum / static_cast<double>(a.bgr.size());
}

TEST(Lab, AMovingRobotIsSeenAtMidExposure) {
  // Blurred to and fro about its middle: the picture is nearest to the one of a robot that rests
  // there.
  LabOptions options = smallLab();
  options.noise = 0;
  options.rest_frames = 0;
  options.exposure = 30ms;
  options.robot_pose_map = [](std::chrono::nanoseconds time) {
    return Eigen::Vector3d(std::chrono::duration<double>(time).count() - 0.5, 0, 0);
  };
  const Frame moving = Lab(options).frame(15);
  const auto restingAt = [&](double x) {
    LabOptions still = options;
    still.robot_pose_map = [x](std::chrono::nanoseconds) { return Eigen::Vector3d(x, 0, 0); };
    return Lab(still).frame(15);
  };
  const double middle = difference(moving, restingAt(0));
  EXPECT_LT(middle, difference(moving, restingAt(0.01)));
  EXPECT_LT(middle, difference(moving, restingAt(-0.01)));
}

TEST(Lab, RollingShutterShearsTheRobot) {
  LabOptions options = smallLab();
  options.noise = 0;
  options.rest_frames = 0;
  options.exposure = 0ms;
  options.robot_pose_map = [](std::chrono::nanoseconds time) {
    return Eigen::Vector3d(0, 3 * (std::chrono::duration<double>(time).count() - 0.5), 0);
  };
  const Frame global = Lab(options).frame(15);
  options.readout = 20ms;
  const Frame rolling = Lab(options).frame(15);
  EXPECT_GT(difference(global, rolling), 0.02);
  options.robot_pose_map = [](std::chrono::nanoseconds) { return Eigen::Vector3d::Zero().eval(); };
  const Frame resting = Lab(options).frame(15);
  options.readout = 0ms;
  EXPECT_EQ(Lab(options).frame(15).bgr, resting.bgr);
}

TEST(Lab, RefusesOptionsThatMakeNoPicture) {
  const auto expectRefused = [](auto change) {
    LabOptions options = smallLab();
    change(options);
    EXPECT_THROW(Lab{options}, std::invalid_argument);
  };
  expectRefused([](LabOptions& o) { o.camera.width = 0; });
  expectRefused([](LabOptions& o) { o.camera.K(0, 1) = 0.3; });
  expectRefused([](LabOptions& o) { o.camera.D = {-0.9, 0, 0, 0, 0}; });
  expectRefused([](LabOptions& o) { o.camera.D = {0.1, 0.2}; });
  expectRefused([](LabOptions& o) { o.fps = 0; });
  expectRefused([](LabOptions& o) { o.robot_tag_id = 587; });
  expectRefused([](LabOptions& o) { o.tags[0].size = 0; });
  expectRefused([](LabOptions& o) { o.exposure = -1ms; });
}

TEST(Lab, DefaultTagsAreInViewAndApart) {
  const LabOptions options = defaultLab();
  ASSERT_GE(options.tags.size(), 4U);
  std::set<int> ids;
  for (const LabTag& tag : options.tags) {
    ids.insert(tag.id);
    EXPECT_GE(tag.id, 100);
    const double half = 0.65 * tag.size;
    for (const Eigen::Vector2d& p : project(options.camera, options.T_world_camera,
                                            {tag.T_world_tag * Eigen::Vector3d(-half, -half, 0),
                                             tag.T_world_tag * Eigen::Vector3d(half, half, 0)})) {
      EXPECT_TRUE(p.x() > 5 && p.x() < options.camera.width - 5) << tag.id;
      EXPECT_TRUE(p.y() > 5 && p.y() < options.camera.height - 5) << tag.id;
    }
    // Outside the taped field, so that nothing stands on them.
    EXPECT_GT(tag.T_world_tag.translation().head<2>().cwiseAbs().maxCoeff(), 1.5 + half);
  }
  EXPECT_EQ(ids.size(), options.tags.size());
}

}  // namespace
}  // namespace slamscope::tracking
