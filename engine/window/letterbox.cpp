// SPDX-License-Identifier: MIT
#include "engine/window/letterbox.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace slamscope::engine {

Letterbox letterbox(const Eigen::Vector2i& picture_px, int views,
                    const Eigen::Vector2i& window_px) {
  if (picture_px.minCoeff() <= 0 || window_px.minCoeff() <= 0 || views <= 0) {
    throw std::invalid_argument("a picture, its window and the number of views must be positive");
  }
  const Eigen::Vector2i whole(picture_px.x() * views, picture_px.y());
  const Eigen::Array2d fit = window_px.cast<double>().array() / whole.cast<double>().array();
  const double scale = fit.minCoeff();
  Letterbox box;
  box.exact = scale == 1.0;
  for (int i = 0; i < 2; ++i) {
    box.size_px[i] = std::clamp(int(std::lround(scale * whole[i])), 1, window_px[i]);
  }
  box.corner_px = (window_px - box.size_px) / 2;
  return box;
}

std::optional<PicturePoint> pictureAt(const Letterbox& box, const Eigen::Vector2i& picture_px,
                                      int views, const Eigen::Vector2d& window_point) {
  const Eigen::Array2d share =
      (window_point - box.corner_px.cast<double>()).array() / box.size_px.cast<double>().array();
  if ((share < 0.0).any() || (share >= 1.0).any()) return std::nullopt;
  PicturePoint point;
  point.view = std::min(int(share.x() * views), views - 1);
  // Windows count from edges, OpenCV from pixel centres.
  point.px.x() = (share.x() * views - point.view) * picture_px.x() - 0.5;
  point.px.y() = share.y() * picture_px.y() - 0.5;
  return point;
}

}  // namespace slamscope::engine
