// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "apps/lib/view/key_commands.hpp"
#include "apps/lib/view/scene_builder.hpp"
#include "tracking/head_overlay.hpp"
#include "tracking/head_path.hpp"
#include "tracking/registration.hpp"
#include "tracking/stereo_lab.hpp"

namespace slamscope::apps {
namespace {

using Eigen::Isometry3d, Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;

/// Extremes over a ring of the squared Mahalanobis distance (px) of its points from its centre.
struct Range {
  double least = 1e9, greatest = 0;
};

template <typename Pixel>
Range rangeOf(const engine::Polyline& ring, const Vector2d& centre_px, const Matrix2d& S_px,
              Pixel pixel) {
  Range range;
  for (const Vector3d& p : ring.points) {
    const Vector2d d = pixel(p) - centre_px;
    const double distance = d.dot(S_px.llt().solve(d));
    range.least = std::min(range.least, distance);
    range.greatest = std::max(range.greatest, distance);
  }
  return range;
}

/// Head and map half known, differently in each direction.
struct UncertainHead {
  tracking::EyeCamera eye{tracking::defaultLabRig(), 0};
  tracking::HeadMotion motion;
  tracking::MapPlace map;

  UncertainHead() {
    motion.T_world_head = tracking::standingHead()(std::chrono::nanoseconds(0));
    motion.covariance.diagonal().head<6>() << 1e-7, 4e-7, 9e-7, 1e-7, 3e-7, 2e-7;
    map.T_world_map =
        Eigen::Translation3d(0.2, -0.1, 0) * Isometry3d(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
    map.covariance.diagonal() << 1e-6, 4e-7, 1e-6;
  }
};

constexpr engine::Rgba kRingColour{};

TEST(OwnError, RingOnTheFloorLooksLikeTheCovarianceOfThePixel) {
  const UncertainHead head;
  const Vector3d p(0.4, 0.3, 0);
  const auto pixel = [&](const Vector3d& p_map) {
    return tracking::projectAt(head.eye, head.motion, head.map.T_world_map * p_map, 0).value();
  };
  const Matrix2d S = tracking::overlayCovariance(head.eye, head.motion, head.map, p).value();
  const Matrix2d P = tracking::overlayCovarianceOnFloor(head.eye, head.motion, head.map, p).value();
  const engine::Polyline ring = floorRing(p.head<2>(), P, 3, kRingColour);
  const Range range = rangeOf(ring, pixel(p), S, pixel);
  EXPECT_NEAR(range.least, 9, 0.2);
  EXPECT_NEAR(range.greatest, 9, 0.2);
  const engine::Polyline round =
      floorRing(p.head<2>(), P.trace() / 2 * Matrix2d::Identity(), 3, kRingColour);
  EXPECT_GT(rangeOf(round, pixel(p), S, pixel).greatest, 10) << "a circle must not pass";
}

TEST(OwnError, OfAnOverheadCameraLikewise) {
  tracking::CameraInfo info;
  info.width = info.height = 1000;
  info.K << 900, 0, 499.5, 0, 900, 499.5, 0, 0, 1;
  const tracking::CameraModel camera(info);
  tracking::RegistrationResult registration;
  registration.T_camera_map =
      Eigen::Translation3d(0, 0, 3) * Isometry3d(Eigen::AngleAxisd(2.8, Vector3d::UnitX()));
  registration.covariance.diagonal() << 1e-6, 4e-6, 2e-6, 1e-6, 2e-6, 3e-6;
  const Vector3d p(0.5, -0.4, 0);
  const auto pixel = [&](const Vector3d& p_map) {
    return camera.project(registration.T_camera_map * p_map).value();
  };
  const Matrix2d S = tracking::overlayCovariance(camera, registration, p).value();
  const Matrix2d P = tracking::overlayCovarianceOnFloor(camera, registration, p).value();
  const Range range = rangeOf(floorRing(p.head<2>(), P, 2, kRingColour), pixel(p), S, pixel);
  EXPECT_NEAR(range.least, 4, 0.1);
  EXPECT_NEAR(range.greatest, 4, 0.1);
}

TEST(OwnError, IsDrawnOnRequest) {
  Viewer::Choices choices;
  KeyCommands keys(choices);
  EXPECT_FALSE(choices.own_error);
  keys.press('o');
  EXPECT_TRUE(choices.own_error);
  keys.press('o');
  EXPECT_FALSE(choices.own_error);
}

}  // namespace
}  // namespace slamscope::apps
