// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

// From where a scene is seen, and what stands behind it.
namespace slamscope::engine {

/// Pinhole camera in OpenCV's convention: integer pixel coordinates are pixel centres.
struct Pinhole {
  int width = 0, height = 0;                      ///< px
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< px
  double skew = 0.0;                              ///< px
};

/// 8-bit picture, tightly packed rows of R, G, B, A; A = 255.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// For each pixel of the drawn picture (rows of width × height) the place in the background picture
/// that it shows, in OpenCV's convention: how a lens is undistorted on the device.
struct LookupMap {
  int width = 0, height = 0;
  std::vector<float> uv_px;  ///< u, v per pixel
};

/// Picture behind the scene. Without a map its pixels are the drawn picture's pixels (same size).
struct Background {
  std::shared_ptr<const Image> image;    ///< none: black
  std::shared_ptr<const LookupMap> map;  ///< uploaded again only when the pointer changes
};

/// One eye. Optical axes: x right, y down, z forward.
struct View {
  Pinhole camera;
  Eigen::Isometry3d T_eye_scene = Eigen::Isometry3d::Identity();
  Background background;
};

}  // namespace slamscope::engine
