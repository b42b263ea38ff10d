// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "engine/render/offscreen.hpp"

// Drawing in tests, and what is measured in what was drawn.
namespace slamscope::engine {

constexpr Rgba kWhite = {1.0F, 1.0F, 1.0F, 1.0F};

/// Draws with validation on; any message of it fails the test. Without Vulkan the test fails.
class PictureTest : public ::testing::Test {
 protected:
  void SetUp() override { gpu_ = std::make_shared<Gpu>(GpuOptions{.validation = true}); }

  void TearDown() override {
    for (const std::string& message : gpu_->validationMessages()) ADD_FAILURE() << message;
  }

  static RenderOptions flat() { return {.lit = false}; }

  /// One picture a view; all views have the first one's size.
  std::vector<Image> draw(std::span<const View> views, const Scene& scene,
                          const RenderOptions& options) {
    const Pinhole& camera = views.front().camera;
    Offscreen offscreen(gpu_, camera.width, camera.height, static_cast<int>(views.size()));
    auto pictures = offscreen.draw(views, scene, options);
    stats_ = offscreen.lastStats();
    return pictures;
  }
  Image draw(const View& view, const Scene& scene, const RenderOptions& options = flat()) {
    return draw({&view, 1}, scene, options).front();
  }

  std::shared_ptr<Gpu> gpu_;
  FrameStats stats_;
};

/// Looks from `eye` at `target`, the scene's z upwards in the picture, then rolled (rad).
inline View lookingAt(const Pinhole& camera, const Eigen::Vector3d& eye,
                      const Eigen::Vector3d& target, double roll = 0.0) {
  const Eigen::Vector3d z = (target - eye).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d R;
  R << x.transpose(), z.cross(x).transpose(), z.transpose();
  R = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix() * R;
  View view;
  view.camera = camera;
  view.T_eye_scene.linear() = R;
  view.T_eye_scene.translation() = -(R * eye);
  return view;
}

inline int channel(const Image& image, int u, int v, int index) {
  return image.rgba[4 * (static_cast<std::size_t>(v) * image.width + u) + index];
}

inline Rgba pixel(const Image& image, int u, int v) {
  return {channel(image, u, v, 0) / 255.0F, channel(image, u, v, 1) / 255.0F,
          channel(image, u, v, 2) / 255.0F, channel(image, u, v, 3) / 255.0F};
}

/// Share of a pixel that is covered where white was drawn on black.
inline double coverage(const Image& image, int u, int v) {
  return channel(image, u, v, 0) / 255.0;
}

struct Moments {
  double area = 0.0;                                 ///< px²
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< px
  /// 4 × second central moments: the shape matrix, where the picture is a filled ellipse. Each
  /// pixel is a square of its own, which adds 1/12 px² to the moments: taken away again.
  Eigen::Matrix2d shape = Eigen::Matrix2d::Zero();
};

inline Moments momentsOf(const Image& image) {
  Moments m;
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const double c = coverage(image, u, v);
      const Eigen::Vector2d p(u, v);
      m.area += c;
      m.centre += c * p;
      second += c * p * p.transpose();
    }
  }
  m.centre /= m.area;
  second = second / m.area - m.centre * m.centre.transpose();
  m.shape = 4.0 * (second - Eigen::Matrix2d::Identity() / 12.0);
  return m;
}

/// Largest difference of a byte, and how many pixels differ by more than was tolerated.
struct Difference {
  int most = 0;
  int pixels = 0;
};

inline Difference difference(const Image& a, const Image& b, int tolerated = 0) {
  Difference d;
  for (int v = 0; v < a.height; ++v) {
    for (int u = 0; u < a.width; ++u) {
      int most = 0;
      for (int i = 0; i < 4; ++i) {
        most = std::max(most, std::abs(channel(a, u, v, i) - channel(b, u, v, i)));
      }
      d.most = std::max(d.most, most);
      d.pixels += most > tolerated ? 1 : 0;
    }
  }
  return d;
}

inline bool sameBytes(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.rgba == b.rgba;
}

}  // namespace slamscope::engine
