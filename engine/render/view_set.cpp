// SPDX-License-Identifier: MIT
#include "engine/render/view_set.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace slamscope::engine {

namespace {

std::string sizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

void requireSize(const char* what, int width, int height, int wanted_width, int wanted_height) {
  if (width != wanted_width || height != wanted_height) {
    throw std::invalid_argument(std::string(what) + " has " + sizeText(width, height) +
                                ", the drawn picture " + sizeText(wanted_width, wanted_height));
  }
}

void requireFitting(const View& view, int width, int height) {
  const Pinhole& camera = view.camera;
  requireSize("the camera", camera.width, camera.height, width, height);
  if (!(camera.fx > 0.0) || !(camera.fy > 0.0)) {
    throw std::invalid_argument("a camera's focal lengths must be positive, these are " +
                                std::to_string(camera.fx) + " and " + std::to_string(camera.fy));
  }
  const Background& background = view.background;
  if (!background.image) return;
  if (background.map) {
    requireSize("the lookup map", background.map->width, background.map->height, width, height);
  } else {
    requireSize("the background", background.image->width, background.image->height, width, height);
  }
}

interop::mat3 toMat3(const Eigen::Matrix3d& m) {
  interop::mat3 columns;
  for (int i = 0; i < 9; ++i) columns[i] = static_cast<float>(m(i % 3, i / 3));
  return columns;
}

/// (0, 0) is a pixel's centre for the camera and the picture's corner for Vulkan.
interop::ViewData viewData(const View& view, const Eigen::Isometry3d& T_shared_scene) {
  const Pinhole& camera = view.camera;
  const Eigen::Isometry3d T_eye_shared = view.T_eye_scene * T_shared_scene.inverse();
  const Background& background = view.background;
  return {.R_eye_shared = toMat3(T_eye_shared.linear()),
          .t_eye_shared = toVec3(T_eye_shared.translation()),
          .up_eye = toVec3(view.T_eye_scene.linear().col(2)),
          .focal = toVec2({camera.fx, camera.fy}),
          .principal = toVec2({camera.cx + 0.5, camera.cy + 0.5}),
          .skew = static_cast<float>(camera.skew),
          .size = toVec2({camera.width, camera.height}),
          .background = !background.image ? 0U
                        : background.map  ? 2U
                                          : 1U};
}

}  // namespace

ViewSet::ViewSet(std::span<const View> views, int width, int height, const RenderOptions& options)
    : views_(views), options_(options), T_shared_scene_(views.front().T_eye_scene) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    requireFitting(views[i], width, height);
    data_.views[i] = viewData(views[i], T_shared_scene_);
  }
  // Exactly, whatever rounding the product with the inverse has.
  data_.views[0].R_eye_shared = toMat3(Eigen::Matrix3d::Identity());
  data_.views[0].t_eye_shared = {};
  data_.near = static_cast<float>(options.near_m);
  data_.border_px = kBorderPx;
}

interop::vec3 ViewSet::point(const Eigen::Vector3d& p_scene) const {
  return toVec3(T_shared_scene_ * p_scene);
}

interop::vec3 ViewSet::direction(const Eigen::Vector3d& v_scene) const {
  return toVec3(T_shared_scene_.linear() * v_scene);
}

interop::vec4 ViewSet::colour(const Rgba& colour) const {
  return {colour.r, colour.g, colour.b, colour.a * std::clamp(options_.opacity, 0.0F, 1.0F)};
}

interop::vec2 toVec2(const Eigen::Vector2d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

interop::vec3 toVec3(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

interop::vec4 toVec4(const Rgba& colour) {
  return {colour.r, colour.g, colour.b, colour.a};
}

}  // namespace slamscope::engine
