// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <random>

#include "engine/scene/pair_glyphs.hpp"
#include "tests/engine/picture.hpp"

// Pairs of points to draw, and what draws them in one way or the other.
namespace slamscope::engine {

inline constexpr Pinhole kFloorCamera = {
    .width = 320, .height = 240, .fx = 300.0, .fy = 310.0, .cx = 158.3, .cy = 121.6, .skew = 5.0};

inline View overFloor() {
  return lookingAt(kFloorCamera, {0.1, -1.6, 1.4}, {0.05, 0.0, 0.0}, 0.1);
}

inline std::vector<double> packed(const Eigen::MatrixXd& P) {
  std::vector<double> lower;
  for (int row = 0; row < P.rows(); ++row) {
    for (int column = 0; column <= row; ++column) lower.push_back(P(row, column));
  }
  return lower;
}

inline PairGlyphs glyphsOf(const std::vector<Eigen::Vector2d>& means, const Eigen::MatrixXd& P) {
  return {.points = std::make_shared<PlanarPoints>(means, packed(P)),
          .axis = {},
          .choice = {},
          .colour = kWhite};
}

inline Scene sceneOf(const PairGlyphs& glyphs) {
  Scene scene;
  scene.pairs = std::make_shared<PairGlyphs>(glyphs);
  return scene;
}

/// Two points whose difference has this covariance, the middle between them at `middle`.
inline PairGlyphs pairWith(const Eigen::Matrix2d& P_d, const Eigen::Vector2d& middle) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(4, 4);
  P.topLeftCorner<2, 2>() = 0.25 * P_d;
  P.bottomRightCorner<2, 2>() = 0.25 * P_d;
  P.bottomLeftCorner<2, 2>() = -0.25 * P_d;
  const Eigen::Vector2d half(0.31, 0.12);
  return glyphsOf({middle - half, middle + half}, P);
}

inline Eigen::Matrix2d covarianceOf(double major, double minor, double angle) {
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return R * Eigen::Vector2d(major * major, minor * minor).asDiagonal() * R.transpose();
}

/// What it must look like.
inline Ellipsoid ellipsoidOf(double major, double minor, double angle,
                             const Eigen::Vector2d& middle) {
  Ellipsoid ellipsoid{.centre = {middle.x(), middle.y(), 0.0}, .axes = {}, .colour = kWhite};
  ellipsoid.axes = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                   Eigen::Vector3d(major, minor, minor).asDiagonal();
  return ellipsoid;
}

/// n points on the floor with a covariance as after some SLAM: a common part and parts of their
/// own.
inline PairGlyphs someMap(int n, double sigma, unsigned seed = 3) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.8, 0.8);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> means;
  for (int i = 0; i < n; ++i) means.emplace_back(place(random), place(random));
  Eigen::MatrixXd root(2 * n, 6);
  for (double& value : root.reshaped()) value = sigma * normal(random);
  Eigen::MatrixXd P = root * root.transpose() / 6.0;
  P.diagonal().array() += 0.2 * sigma * sigma;
  return glyphsOf(means, P);
}

/// Draws again and again with what was made once.
class PairTest : public PictureTest {
 protected:
  std::vector<Image> draw(std::span<const View> views, const Scene& scene,
                          const RenderOptions& options) {
    auto& made = offscreen_[views.size() - 1];
    const Pinhole& camera = views.front().camera;
    const int count = static_cast<int>(views.size());
    if (!made) made = std::make_unique<Offscreen>(gpu_, camera.width, camera.height, count);
    auto pictures = made->draw(views, scene, options);
    stats_ = made->lastStats();
    return pictures;
  }
  Image draw(const View& view, const Scene& scene, const RenderOptions& options) {
    return draw({&view, 1}, scene, options).front();
  }
  /// What drew that many views last.
  Offscreen& offscreen(std::size_t views) { return *offscreen_.at(views - 1); }
  void useGpu(const GpuOptions& options) {
    offscreen_ = {};
    gpu_ = std::make_shared<Gpu>(options);
  }

 private:
  std::array<std::unique_ptr<Offscreen>, 2> offscreen_;
};

/// One way of drawing, with everything else equal.
class PairPicture : public PairTest, public ::testing::WithParamInterface<PairWay> {
 protected:
  [[nodiscard]] static RenderOptions options(bool lit = false) {
    return {.lit = lit, .pair_way = GetParam()};
  }
  Image drawn(const View& view, const Scene& scene) {
    Image image = draw(view, scene, options());
    EXPECT_EQ(stats_.pairs.splatted, GetParam() == PairWay::splats);
    return image;
  }
};

}  // namespace slamscope::engine
