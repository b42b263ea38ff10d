// SPDX-License-Identifier: MIT
#include "tracking/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

#include "tracking/undistort.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

CameraInfo lens(DistortionModel model, std::vector<double> D, double skew = 0) {
  CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K << 420, skew, 310.3, 0, 430, 243.9, 0, 0, 1;
  info.model = model;
  info.D = std::move(D);
  return info;
}

std::vector<CameraInfo> lenses(double skew = 0) {
  using enum DistortionModel;
  return {lens(plumb_bob, {}, skew),
          lens(plumb_bob, {-0.28, 0.09, 0.001, -0.0015, -0.01}, skew),
          lens(plumb_bob, {0.12, -0.05, 0.0005, 0.001}, skew),
          lens(rational_polynomial, {0.4, 0.1, 0.0004, -0.0003, 0.01, 0.75, 0.22, 0.03}, skew),
          lens(equidistant, {-0.03, 0.004, -0.002, 0.0003}, skew),
          lens(equidistant, {}, skew)};
}

Vector3d randomPoint(std::mt19937& random) {
  std::uniform_real_distribution<double> side(-0.7, 0.7), depth(0.5, 5);
  const double z = depth(random);
  return {side(random) * z, side(random) * z, z};
}

Vector2d byOpenCv(const CameraInfo& info, const Vector3d& p) {
  const std::vector<cv::Point3d> points{{p.x(), p.y(), p.z()}};
  std::vector<cv::Point2d> px;
  const cv::Matx33d K(info.K(0, 0), 0, info.K(0, 2), 0, info.K(1, 1), info.K(1, 2), 0, 0, 1);
  const cv::Vec3d none(0, 0, 0);
  std::vector<double> D = info.D;
  if (info.model == DistortionModel::equidistant) {
    if (D.empty()) D.resize(4, 0);
    cv::fisheye::projectPoints(points, px, cv::Affine3d(), K, D, info.K(0, 1) / info.K(0, 0));
  } else {
    cv::projectPoints(points, none, none, K, D, px);
  }
  return {px[0].x, px[0].y};
}

double worstAgainstOpenCv(const CameraInfo& mine, const CameraInfo& theirs) {
  const CameraModel camera(mine);
  std::mt19937 random(1);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d p = randomPoint(random);
    const auto px = camera.project(p);
    if (px) worst = std::max(worst, (*px - byOpenCv(theirs, p)).norm());
  }
  return worst;
}

TEST(CameraModel, ProjectsAsOpenCvDoes) {
  for (const CameraInfo& info : lenses()) EXPECT_LT(worstAgainstOpenCv(info, info), 1e-9);
  const CameraInfo skewed = lens(DistortionModel::equidistant, {-0.03, 0.004, -0.002, 0.0003}, 2.5);
  EXPECT_LT(worstAgainstOpenCv(skewed, skewed), 1e-9);
}

TEST(CameraModel, ComparisonWithOpenCvSeesSwappedTangentialTerms) {
  const CameraInfo info = lens(DistortionModel::plumb_bob, {-0.28, 0.09, 0.001, -0.0015, 0});
  CameraInfo swapped = info;
  std::swap(swapped.D[2], swapped.D[3]);
  EXPECT_GT(worstAgainstOpenCv(swapped, info), 0.1);
}

TEST(CameraModel, SkewMovesAlongRowsByHeight) {
  const CameraModel camera(lens(DistortionModel::plumb_bob, {}, 4));
  const auto px = camera.project({0.1, 0.2, 1});
  EXPECT_NEAR(px->x(), 420 * 0.1 + 4 * 0.2 + 310.3, 1e-12);
}

TEST(CameraModel, RoundTripsAllOverThePicture) {
  for (const double skew : {0.0, 3.0}) {
    for (const CameraInfo& info : lenses(skew)) {
      const CameraModel camera(info);
      for (double v = 0; v < 480; v += 17) {
        for (double u = 0; u < 640; u += 17) {
          const auto ray = camera.unproject({u, v});
          ASSERT_TRUE(ray);
          EXPECT_NEAR(ray->norm(), 1, 1e-12);
          const auto px = camera.project(2.5 * *ray);
          ASSERT_TRUE(px);
          EXPECT_LT((*px - Vector2d(u, v)).norm(), 1e-8);
        }
      }
    }
  }
}

double jacobianError(const CameraModel& camera, const Vector3d& p, double sign = 1) {
  PixelJacobian J;
  if (!camera.project(p, &J)) return 1e9;
  J(0, 2) *= sign;
  PixelJacobian numeric;
  constexpr double h = 1e-5;
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = h * Vector3d::Unit(k);
    numeric.col(k) = (*camera.project(p + d) - *camera.project(p - d)) / (2 * h);
  }
  return (J - numeric).norm() / numeric.norm();
}

TEST(CameraModel, JacobianIsTheDerivative) {
  std::mt19937 random(2);
  for (const CameraInfo& info : lenses(1.5)) {
    const CameraModel camera(info);
    EXPECT_LT(jacobianError(camera, {0, 0, 1}), 1e-7);
    EXPECT_LT(jacobianError(camera, {1e-9, -1e-9, 2}), 1e-7);
    EXPECT_LT(jacobianError(camera, {3e-5, 1e-5, 2}), 1e-7);
    for (int i = 0; i < 100; ++i) {
      EXPECT_LT(jacobianError(camera, 2 * Vector3d(0, 0, 1) + randomPoint(random)), 1e-7);
    }
    EXPECT_GT(jacobianError(camera, {0.3, 0.2, 1}, -1), 1e-2) << "a flipped sign must be seen";
  }
}

TEST(CameraModel, PointsBehindAreOutsideOfTheValidSet) {
  for (const CameraInfo& info : lenses()) {
    EXPECT_FALSE(CameraModel(info).project({0.1, 0.1, -1}) &&
                 info.model != DistortionModel::equidistant);
    EXPECT_FALSE(CameraModel(info).project({0, 0, -1}));
    EXPECT_FALSE(CameraModel(info).project({0, 0, 0}));
  }
}

TEST(CameraModel, PointsThatFoldBackAreOutsideOfTheValidSet) {
  // r (1 − 0.5 r²) stops growing at r = sqrt(2/3).
  const CameraModel camera(lens(DistortionModel::plumb_bob, {-0.5, 0, 0, 0}));
  EXPECT_NEAR(std::tan(camera.maxAngle()), std::sqrt(2.0 / 3), 1e-6);
  EXPECT_TRUE(camera.project({0.81, 0, 1}));
  EXPECT_FALSE(camera.project({0.82, 0, 1}));
  EXPECT_FALSE(camera.unproject({310.3 + 420 * 0.55, 243.9})) << "no point projects that far out";
}

TEST(CameraModel, SeesBesideItselfThroughAFisheye) {
  const CameraModel camera(lens(DistortionModel::equidistant, {}));
  const auto px = camera.project({1, 0, -0.1});
  ASSERT_TRUE(px);
  EXPECT_LT((*camera.unproject(*px) - Vector3d(1, 0, -0.1).normalized()).norm(), 1e-12);
}

TEST(CameraModel, RefusesWhatIsNoCamera) {
  CameraInfo info = lens(DistortionModel::plumb_bob, {1, 2, 3});
  EXPECT_THROW(CameraModel{info}, std::invalid_argument);
  info.D.clear();
  info.K(1, 0) = 1;
  EXPECT_THROW(CameraModel{info}, std::invalid_argument);
  info.K(1, 0) = 0;
  info.width = 0;
  EXPECT_THROW(CameraModel{info}, std::invalid_argument);
}

TEST(UndistortMap, IsOpenCvsMap) {
  const CameraInfo info = lens(DistortionModel::plumb_bob, {-0.28, 0.09, 0.001, -0.0015, -0.01});
  const CameraInfo pinhole = idealPinhole(info, 320, 200);
  const UndistortMap map = undistortMap(info, pinhole);
  ASSERT_EQ(map.uv.size(), 2U * 320 * 200);
  const auto matrix = [](const Eigen::Matrix3d& K) {
    return cv::Matx33d(K(0, 0), K(0, 1), K(0, 2), 0, K(1, 1), K(1, 2), 0, 0, 1);
  };
  cv::Mat u, v;
  cv::initUndistortRectifyMap(matrix(info.K), info.D, cv::noArray(), matrix(pinhole.K), {320, 200},
                              CV_32FC1, u, v);
  double worst = 0, shifted = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 320; ++x) {
      const std::size_t i = 2 * (std::size_t(y) * 320 + std::size_t(x));
      const double du = map.uv[i] - u.at<float>(y, x), dv = map.uv[i + 1] - v.at<float>(y, x);
      worst = std::max(worst, std::hypot(du, dv));
      shifted = std::max(shifted, std::hypot(du + 0.5, dv + 0.5));
    }
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(shifted, 0.1) << "half a pixel must be seen";
}

}  // namespace
}  // namespace slamscope::tracking
