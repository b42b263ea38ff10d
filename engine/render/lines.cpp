// SPDX-License-Identifier: MIT
#include "engine/render/lines.hpp"

#include <algorithm>
#include <cmath>

#include "engine/render/shader_code.hpp"
#include "engine/scene/clip.hpp"

namespace slamscope::engine {

namespace {

constexpr double kLeastStepPx = 0.5;

bool drawable(const Polyline& line) {
  return std::isfinite(line.width_px) && line.width_px > 0.0 &&
         std::ranges::all_of(line.points, [](const auto& point) { return point.allFinite(); });
}

bool showsAlike(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const ViewSet& views) {
  return std::ranges::all_of(views.views(), [&](const View& view) {
    const Eigen::Vector3d a_eye = view.T_eye_scene * a;
    const Eigen::Vector3d b_eye = view.T_eye_scene * b;
    const double near = views.options().near_m;
    if (a_eye.z() < near || b_eye.z() < near) return a == b;
    return (project(view.camera, a_eye) - project(view.camera, b_eye)).norm() < kLeastStepPx;
  });
}

/// The last point always stays.
std::vector<Eigen::Vector3d> thinned(const std::vector<Eigen::Vector3d>& points,
                                     const ViewSet& views) {
  std::vector<Eigen::Vector3d> kept;
  for (const Eigen::Vector3d& point : points) {
    if (kept.empty() || !showsAlike(kept.back(), point, views)) kept.push_back(point);
  }
  if (kept.size() == 1) {
    kept.push_back(points.back());
  } else if (!kept.empty()) {
    kept.back() = points.back();
  }
  return kept;
}

}  // namespace

LinePass::LinePass(const PassSetup& setup)
    : instances_(setup.core),
      looks_(setup.core,
             {.vertex = shaderCode("lines_vert"),
              .fragment = shaderCode("lines_frag"),
              .sets = {setup.frame_layout, instances_.set().layout()},
              .view_mask = setup.view_mask},
             0, Picked::Kind::line) {}

void LinePass::append(const Polyline& line, const ViewSet& views) {
  std::vector<interop::vec3> points;
  for (const Eigen::Vector3d& point : thinned(line.points, views)) {
    points.push_back(views.point(point));
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    segments_.push_back({.previous = points[i > 0 ? i - 1 : 0],
                         .from = points[i],
                         .to = points[i + 1],
                         .next = points[std::min(i + 2, points.size() - 1)],
                         .width_px = static_cast<float>(line.width_px),
                         .colour = views.colour(line.colour)});
    tags_.push_back(line.tag);
  }
}

void LinePass::update(std::span<const Polyline> lines, const ViewSet& views, int& not_drawn) {
  segments_.clear();
  tags_.clear();
  for (const Polyline& line : lines) {
    if (drawable(line)) {
      append(line, views);
    } else {
      ++not_drawn;
    }
  }
  instances_.upload<interop::SegmentGlyph>(segments_);
}

void LinePass::record(const FrameContext& context) const {
  context.draw("lines", looks_[context.look], instances_.set().handle(), 4, instances_.count());
}

}  // namespace slamscope::engine
