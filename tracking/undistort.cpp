// SPDX-License-Identifier: MIT
#include "tracking/undistort.hpp"

#include <stdexcept>

#include "tracking/camera_model.hpp"

namespace slamscope::tracking {

UndistortMap undistortMap(const CameraInfo& source, const Eigen::Matrix3d& K, int width,
                          int height) {
  CameraInfo pinhole;
  pinhole.width = width;
  pinhole.height = height;
  pinhole.K = K;
  const CameraModel from(std::move(pinhole)), to(source);
  UndistortMap map{width, height, {}};
  map.uv.reserve(2UL * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const auto ray = from.unproject({column, row});
      const auto px = ray ? to.project(*ray) : std::nullopt;
      map.uv.push_back(px ? static_cast<float>(px->x()) : UndistortMap::kNowhere);
      map.uv.push_back(px ? static_cast<float>(px->y()) : UndistortMap::kNowhere);
    }
  }
  return map;
}

UndistortMap undistortMap(const CameraInfo& source, const CameraInfo& pinhole) {
  return undistortMap(source, pinhole.K, pinhole.width, pinhole.height);
}

}  // namespace slamscope::tracking
