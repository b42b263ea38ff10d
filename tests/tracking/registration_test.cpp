// SPDX-License-Identifier: MIT
#include "tracking/registration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "seen_tags.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;
using std::chrono::milliseconds;
using testing::floorTags, testing::lookingDown, testing::overheadCamera, testing::perturbation,
    testing::seeLayout, testing::seeTag;

Isometry3d mapAt(double x, double y, double yaw) {
  Isometry3d T(Translation3d(x, y, 0));
  T.linear() = AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

/// Overhead camera, robot in the middle of its floor.
struct Room {
  CameraModel camera{overheadCamera()};
  Isometry3d T_camera_world = lookingDown();
  Isometry3d T_world_map = mapAt(0.1, -0.05, 0.4);
  RobotTag robot{};
  TagLayout floor{};
  double sigma_px = 0.1;
  std::mt19937 random{11};

  [[nodiscard]] std::vector<TagDetection> look() {
    auto tags = seeLayout(camera, floor, T_camera_world, sigma_px, random);
    tags.push_back(seeTag(camera, T_camera_world * T_world_map * robot.T_robot_tag, robot.id,
                          robot.size_m, sigma_px, random));
    return tags;
  }
  [[nodiscard]] RegistrationOptions given() const {
    RegistrationOptions options;
    options.robot = robot;
    options.camera_pose = CameraPose{T_camera_world};
    options.corner_bias_px = 0;
    return options;
  }
  /// Distances in the picture between where estimate and truth draw the 3 m × 3 m floor.
  void overlayErrors(const Isometry3d& T_camera_map, std::vector<double>& errors) const {
    for (double x = -1.5; x <= 1.5; x += 0.3) {
      for (double y = -1.5; y <= 1.5; y += 0.3) {
        const Vector3d p_map = T_world_map.inverse() * Vector3d(x, y, 0);
        const auto truth = camera.project(T_camera_world * T_world_map * p_map);
        const auto drawn = camera.project(T_camera_map * p_map);
        if (truth && drawn) errors.push_back((*truth - *drawn).norm());
      }
    }
  }
};

double p95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() * 95 / 100];
}

Isometry3d registered(Room& room, RegistrationOptions options, int frames) {
  options.frames = frames;
  Registration registration(std::move(options), room.camera);
  for (int k = 0; k < frames; ++k) registration.add(milliseconds(33 * k), room.look());
  return registration.result().value().T_camera_map;
}

TEST(Registration, PlaneAndAveragingBringTheSpecifiedPrecision) {
  Room room;
  std::vector<double> one_frame, averaged, averaged_free, free;
  for (int k = 0; k < 60; ++k) {
    room.overlayErrors(registered(room, room.given(), 1), one_frame);
    room.overlayErrors(registered(room, room.given(), 30), averaged);
    RegistrationOptions nothing_known = room.given();
    nothing_known.camera_pose.reset();
    room.overlayErrors(registered(room, nothing_known, 1), free);
  }
  EXPECT_LT(p95(one_frame), 0.95);
  EXPECT_GT(p95(one_frame), 0.5);
  EXPECT_LT(p95(averaged), 0.17);
  EXPECT_GT(p95(free), 4) << "a free tag's pose is no registration";
}

/// Mean NEES of (x, y, yaw) over runs; the noise is `factor` times what is stated.
double registrationNees(double factor, int runs) {
  Room room;
  room.sigma_px = 0.1 * factor;
  double sum = 0;
  for (int k = 0; k < runs; ++k) {
    RegistrationOptions options = room.given();
    options.frames = 5;
    Registration registration(options, room.camera);
    for (int i = 0; i < 5; ++i) {
      auto tags = room.look();
      for (TagDetection& tag : tags) tag.sigma_px.fill(0.1);
      registration.add(milliseconds(i), tags);
    }
    const auto& result = registration.result().value();
    const auto d = perturbation(result.T_camera_map, room.T_camera_world * room.T_world_map);
    const Vector3d planar(d[0], d[1], d[5]);
    Eigen::Matrix3d S;
    const int at[3] = {0, 1, 5};
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) S(r, c) = result.covariance(at[r], at[c]);
    }
    sum += testing::nees(planar, S);
  }
  return sum / runs;
}

TEST(Registration, PlanarCovarianceIsHonest) {
  constexpr int kRuns = 1000;
  const testing::Band band = testing::neesBand(3, kRuns);
  const double nees = registrationNees(1, kRuns);
  EXPECT_TRUE(band.holds(nees)) << nees;
  EXPECT_FALSE(band.holds(registrationNees(1.15, kRuns)))
      << "noise 15 % larger than stated must show";
}

/// Mean over runs of (pixel error)ᵀ Σ_uv⁻¹ (pixel error) at one floor point, camera by floor tags.
double overlayNees(double factor, int runs) {
  Room room;
  room.floor = floorTags(4);
  room.sigma_px = 0.1 * factor;
  const Vector3d p_map(0.8, -0.6, 0);
  double sum = 0;
  for (int k = 0; k < runs; ++k) {
    RegistrationOptions options = room.given();
    options.camera_pose.reset();
    options.layout = room.floor;
    options.frames = 2;
    Registration registration(options, room.camera);
    for (int i = 0; i < 2; ++i) {
      auto tags = room.look();
      for (TagDetection& tag : tags) tag.sigma_px.fill(0.1);
      registration.add(milliseconds(i), tags);
    }
    const auto& result = registration.result().value();
    const Eigen::Vector2d e = *room.camera.project(result.T_camera_map * p_map) -
                              *room.camera.project(room.T_camera_world * room.T_world_map * p_map);
    sum += testing::nees(e, *overlayCovariance(room.camera, result, p_map));
  }
  return sum / runs;
}

TEST(Registration, PredictedOverlayErrorIsHonest) {
  constexpr int kRuns = 300;
  const testing::Band band = testing::neesBand(2, kRuns);
  const double nees = overlayNees(1, kRuns);
  EXPECT_TRUE(band.holds(nees)) << nees;
  EXPECT_FALSE(band.holds(overlayNees(1.2, kRuns)));
}

TEST(Registration, UncertainCameraPoseShowsInTheOverlay) {
  Room room;
  RegistrationOptions options = room.given();
  options.frames = 1;
  Registration exact(options, room.camera);
  exact.add(milliseconds(0), room.look());
  options.camera_pose->sigma_position_m = 0.01;
  options.camera_pose->sigma_rotation_rad = 0.002;
  Registration rough(options, room.camera);
  rough.add(milliseconds(0), room.look());
  EXPECT_GT(rough.result()->overlay_error_px, 1.2 * exact.result()->overlay_error_px);
  EXPECT_GT(rough.result()->floor_error_mm, exact.result()->floor_error_mm);
}

TEST(Registration, GathersThenStores) {
  Room room;
  Registration registration(room.given(), room.camera);
  EXPECT_EQ(registration.state(), RegistrationState::searching);
  registration.add(milliseconds(0), {});
  EXPECT_EQ(registration.status(), "searching: no robot's tag 0 (36h11) in view");
  for (int k = 1; k < 30; ++k) registration.add(milliseconds(33 * k), room.look());
  EXPECT_EQ(registration.state(), RegistrationState::registering);
  EXPECT_EQ(registration.status(), "registering: frame 29 of 30");
  EXPECT_FALSE(registration.result());
  registration.add(milliseconds(1000), room.look());
  EXPECT_EQ(registration.state(), RegistrationState::registered);
  EXPECT_EQ(registration.result()->frames, 30);
  EXPECT_NE(registration.status().find("registered (plane): 30 frames, 1 tag, residual 0.1"),
            std::string::npos)
      << registration.status();
  const auto stored = registration.result()->T_camera_map.matrix();
  room.T_world_map = mapAt(1, 1, 1);  // the robot goes its way
  registration.add(milliseconds(1033), room.look());
  registration.add(milliseconds(1066), {});
  EXPECT_EQ(registration.result()->T_camera_map.matrix(), stored);
}

TEST(Registration, RobotThatSetsOffEarlyIsRegisteredWhereItStood) {
  Room room;
  room.sigma_px = 0.02;
  Registration registration(room.given(), room.camera);
  for (int k = 0; k < 10; ++k) registration.add(milliseconds(33 * k), room.look());
  const Isometry3d start = room.T_camera_world * room.T_world_map;
  room.T_world_map = mapAt(0.15, -0.05, 0.4);
  registration.add(milliseconds(330), room.look());
  ASSERT_EQ(registration.state(), RegistrationState::registered);
  EXPECT_EQ(registration.result()->frames, 10);
  EXPECT_LT(perturbation(start, registration.result()->T_camera_map).norm(), 1e-3);
}

TEST(Registration, MovingRobotIsNoStart) {
  Room room;
  Registration registration(room.given(), room.camera);
  for (int k = 0; k < 100; ++k) {
    room.T_world_map = mapAt(-0.5 + 0.01 * k, 0, 0);
    registration.add(milliseconds(33 * k), room.look());
  }
  EXPECT_EQ(registration.state(), RegistrationState::registering);
}

TEST(Registration, FewFramesAreSettledFor) {
  Room room;
  Registration registration(room.given(), room.camera);
  registration.settle();
  EXPECT_EQ(registration.state(), RegistrationState::searching);
  registration.add(milliseconds(0), room.look());
  registration.settle();
  EXPECT_EQ(registration.state(), RegistrationState::registered);
  EXPECT_EQ(registration.result()->frames, 1);
}

std::string problemsOf(Room& room, const RegistrationOptions& options) {
  Registration registration(options, room.camera);
  for (int k = 0; k < 30; ++k) registration.add(milliseconds(33 * k), room.look());
  std::string all;
  for (const std::string& problem : registration.problems()) all += problem + "\n";
  return all;
}

TEST(Registration, NamesWhatDoesNotFit) {
  Room room;
  RegistrationOptions options = room.given();
  EXPECT_EQ(problemsOf(room, options), "");
  options.robot->size_m = 0.22;
  EXPECT_NE(
      problemsOf(room, options).find("robot's tag 0 looks 0.200 m wide where 0.220 m is stated"),
      std::string::npos)
      << problemsOf(room, options);

  Room tagged;
  tagged.floor = floorTags(4);
  RegistrationOptions layout = tagged.given();
  layout.camera_pose.reset();
  layout.layout = tagged.floor;
  EXPECT_EQ(problemsOf(tagged, layout), "");
  layout.layout.tags[1].T_world_tag.pretranslate(Vector3d(0.1, 0, 0));
  EXPECT_NE(problemsOf(tagged, layout).find("tag 101 does not fit the others"), std::string::npos)
      << problemsOf(tagged, layout);

  // Wrong intrinsics: the floor's tags can't all fit. (A wrong focal length alone over a flat
  // floor, seen straight down, is another height; the robot's tag, which isn't on the floor,
  // tells.)
  Room wrong;
  wrong.floor = floorTags(8);
  wrong.sigma_px = 0.02;
  CameraInfo info = overheadCamera();
  info.D = {-0.3, 0, 0, 0};
  RegistrationOptions undistorted = wrong.given();
  undistorted.camera_pose.reset();
  undistorted.layout = wrong.floor;
  const CameraModel real(info);
  Registration registration(undistorted, wrong.camera);
  wrong.camera = real;
  for (int k = 0; k < 30; ++k) registration.add(milliseconds(33 * k), wrong.look());
  EXPECT_FALSE(registration.problems().empty());
}

TEST(Registration, RobotsTagSeenTwiceIsNamedAndNotTaken) {
  Room room;
  Registration registration(room.given(), room.camera);
  auto tags = room.look();
  tags.push_back(tags.back());
  registration.add(milliseconds(0), tags);
  EXPECT_EQ(registration.state(), RegistrationState::searching);
  ASSERT_EQ(registration.problems().size(), 1U);
  EXPECT_EQ(registration.problems()[0], "robot's tag 0 is seen more than once");
}

TEST(Registration, CameraThatMovesIsFoundInEachFrame) {
  Room room;
  room.floor = floorTags(8);
  RegistrationOptions options = room.given();
  options.camera_pose.reset();
  options.layout = room.floor;
  options.continuous = true;
  options.frames = 10;
  Registration registration(options, room.camera);
  const auto carry = [&](int k) {
    room.T_camera_world = Translation3d(0.01 * k, 0.005 * k, 0.01 * k) *
                          AngleAxisd(0.01 * k, Vector3d(1, 1, 0).normalized()) * lookingDown();
  };
  const Isometry3d start = room.T_world_map;
  for (int k = 0; k < 30; ++k) {
    carry(k);
    if (k >= 12) room.T_world_map = mapAt(0.01 * k, 0, 0);  // the robot drives, the map stays
    registration.add(milliseconds(33 * k), room.look());
    if (k < 9) {
      EXPECT_EQ(registration.state(), RegistrationState::registering);
    } else {
      ASSERT_EQ(registration.state(), RegistrationState::registered) << k;
      const auto d = perturbation(registration.result()->T_camera_map, room.T_camera_world * start);
      EXPECT_LT(d.norm(), 0.005) << k;
      EXPECT_LT(testing::nees(d, registration.result()->covariance), 27.9) << "chi² 99.99 %";
    }
  }
  registration.add(milliseconds(1000), {});
  EXPECT_EQ(registration.state(), RegistrationState::lost);
  EXPECT_FALSE(registration.result());
  EXPECT_EQ(registration.status(), "lost: no tag of the layout (36h11) in view");
  registration.add(milliseconds(1033), room.look());
  EXPECT_EQ(registration.state(), RegistrationState::registered) << "at once";
}

TEST(Registration, BoardNeedsNoRobot) {
  Room room;
  room.floor = floorTags(4);
  RegistrationOptions options;
  options.robot.reset();
  options.layout = room.floor;
  options.continuous = true;
  Registration registration(options, room.camera);
  registration.add(milliseconds(0), room.look());
  ASSERT_EQ(registration.state(), RegistrationState::registered);
  EXPECT_EQ(registration.mode(), RegistrationMode::layout);
  EXPECT_LT(perturbation(room.T_camera_world, registration.result()->T_camera_map).norm(), 0.01);
}

TEST(Registration, CameraPoseAloneIsRegisteredAtOnce) {
  Room room;
  RegistrationOptions options = room.given();
  options.robot.reset();
  const Registration registration(options, room.camera);
  ASSERT_EQ(registration.state(), RegistrationState::registered);
  EXPECT_TRUE(registration.result()->T_camera_map.isApprox(room.T_camera_world));
}

TEST(Registration, RobotsTagAloneSaysSo) {
  Room room;
  room.T_camera_world.linear() = AngleAxisd(0.5, Vector3d::UnitX()) * room.T_camera_world.linear();
  room.T_camera_world.pretranslate(Vector3d(0, 1.4, 0));
  room.sigma_px = 0.03;
  RegistrationOptions options = room.given();
  options.camera_pose.reset();
  Registration registration(options, room.camera);
  EXPECT_EQ(registration.status(), "searching: waiting for frames");
  registration.add(milliseconds(0), {});
  EXPECT_EQ(registration.status(), "searching: no robot's tag 0 (36h11) in view");
  for (int k = 0; k < 30; ++k) registration.add(milliseconds(33 * k), room.look());
  EXPECT_EQ(registration.mode(), RegistrationMode::free_tag);
  ASSERT_EQ(registration.state(), RegistrationState::registered) << registration.status();
  EXPECT_NE(registration.status().find("(free-tag)"), std::string::npos);
}

TEST(Registration, RefusesWhatCanNeverRegister) {
  const CameraModel camera(overheadCamera());
  RegistrationOptions nothing;
  nothing.robot.reset();
  EXPECT_THROW(Registration(nothing, camera), std::invalid_argument);
  RegistrationOptions families;
  families.layout = floorTags(1);
  families.layout.family = "25h9";
  EXPECT_THROW(Registration(families, camera), std::invalid_argument);
  RegistrationOptions same;
  same.layout = floorTags(1);
  same.robot->id = 100;
  EXPECT_THROW(Registration(same, camera), std::invalid_argument);
  RegistrationOptions no_frames;
  no_frames.frames = 0;
  EXPECT_THROW(Registration(no_frames, camera), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::tracking
