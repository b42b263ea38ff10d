// SPDX-License-Identifier: MIT
#include "engine/scene/lens.hpp"

namespace slamscope::engine {

Eigen::Vector2d drawnPixel(const Lens& lens, const Eigen::Vector2d& size_px,
                           const Eigen::Vector2d& shown) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5);  // to corners and back, as lens.frag
  const Eigen::Vector2d axis = lens.centre.cwiseProduct(size_px);
  const Eigen::Vector2d off = shown + half - axis;
  const double s = off.squaredNorm() / (0.25 * size_px.y() * size_px.y());
  const double factor = 1.0 + s * (lens.k.x() + s * (lens.k.y() + s * lens.k.z()));
  return axis + lens.scale.y() * factor * off - half;
}

}  // namespace slamscope::engine
