// SPDX-License-Identifier: MIT
#include "tracking/tag_corners.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tracking/tag_edge.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Vector2d;

/// Corners further from where they started than this are not the ones that were meant.
constexpr double kMaxShift_px = 2.5;
/// Cells that are less deep, as seen aslant, leave no room for an edge.
constexpr double kLeastCell_px = 2.4;
// Blur (standard deviation) beyond which motion has smeared a side, and how far the grey levels of
// its neighbours are from its own, part of the contrast.
constexpr double kSmeared_px = 1.1, kLevelsDiffer = 0.03;
/// What is left of a corner's error where noise averages out: response of pixels, rounding to
/// bytes.
constexpr double kFloor_px = 0.004;

/// How the lens bends the straight line between two corners.
Bow bowOf(const CameraModel* camera, const Chord& chord) {
  if (!camera || camera->undistorted()) return {};
  const auto first = camera->unproject(chord.first), last = camera->unproject(chord.last);
  if (!first || !last) return {};
  Eigen::Matrix3d A;
  Eigen::Vector3d height;
  for (int k = 0; k < 3; ++k) {
    const double part = 0.25 * (k + 1);
    const auto px = camera->project((1 - part) * *first / first->z() + part * *last / last->z());
    if (!px) return {};
    const double u = chord.along(*px) / chord.half;
    A.row(k) = (1 - u * u) * Eigen::RowVector3d(1, u, u * u);
    height[k] = chord.across(*px);
  }
  return {A.partialPivLu().solve(height)};
}

/// Depth of one cell behind side i, and how far from its ends the neighbours' edges begin to show.
struct Surroundings {
  double cell, reach;
};

Surroundings surroundings(const std::array<Vector2d, 4>& c, std::size_t i, int cells) {
  const Chord side(c[i], c[(i + 1) % 4]);
  const Vector2d left = c[(i + 3) % 4] - c[i], right = c[(i + 2) % 4] - c[(i + 1) % 4];
  const double depth_left = std::abs(side.normal.dot(left)),
               depth_right = std::abs(side.normal.dot(right));
  const double lean = std::max(std::abs(side.direction.dot(left)) / std::max(depth_left, 1e-9),
                               std::abs(side.direction.dot(right)) / std::max(depth_right, 1e-9));
  return {std::min(depth_left, depth_right) / cells, lean};
}

/// Error (px) that the bits one cell further in cause: their blurred edges reach into the window.
/// An empirical fit to rendered tags, cells of 3 to 5 px, blur 0.3 to 0.9 px.
double neighboursPull(double cell, double half_width, double blur) {
  const double s = std::hypot(blur, 0.29);  // 0.29: a pixel's own width
  const double tail = std::erfc((cell - half_width) / s / std::numbers::sqrt2) / 2;
  return 0.35 * tail * std::pow(2 / half_width, 2);
}

/// One side. `known`: grey levels to take instead of the side's own.
std::optional<EdgeFit> fitSide(const ImageView& grey, const Chord& chord, const Bow& bow,
                               const Surroundings& around,
                               const std::optional<GreyLevels>& known = {}) {
  EdgeWindow window;
  window.half_width = std::clamp(around.cell - 1.0, 2.0, 3.5);
  window.margin = 2 + window.half_width * around.reach;
  window.known = known;
  auto side = fitEdge(grey, chord, bow, window);
  if (!side) return std::nullopt;
  const double pull = neighboursPull(around.cell, window.half_width, side->blur);
  side->covariance(0, 0) += pull * pull;
  return side;
}

/// Of the sides that nothing has smeared; nothing where there is none.
std::optional<GreyLevels> sharpLevels(const std::array<EdgeFit, 4>& sides) {
  GreyLevels sum{0, 0};
  int count = 0;
  for (const EdgeFit& side : sides) {
    if (side.blur > kSmeared_px) continue;
    sum.behind += side.levels.behind;
    sum.ahead += side.levels.ahead;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return GreyLevels{sum.behind / count, sum.ahead / count};
}

std::optional<std::array<EdgeFit, 4>> fitSides(const ImageView& grey,
                                               const std::array<Vector2d, 4>& corners,
                                               const CornerRefinement& options) {
  std::array<EdgeFit, 4> sides;
  const auto fit = [&](std::size_t i, const std::optional<GreyLevels>& known) {
    const Chord chord(corners[i], corners[(i + 1) % 4]);
    const Surroundings around = surroundings(corners, i, options.cells);
    if (2 * chord.half < options.least_side_px || around.cell < kLeastCell_px) return false;
    const auto side = fitSide(grey, chord, bowOf(options.camera, chord), around, known);
    if (side) sides[i] = *side;
    return side.has_value();
  };
  for (std::size_t i = 0; i < 4; ++i) {
    if (!fit(i, std::nullopt)) return std::nullopt;
  }
  // A side that motion has smeared over a cell shows neither of its grey levels, and without them
  // no place; the sides along the motion show both.
  const std::optional<GreyLevels> known = sharpLevels(sides);
  for (std::size_t i = 0; known && i < 4; ++i) {
    if (sides[i].blur <= kSmeared_px) continue;
    if (!fit(i, known)) return std::nullopt;
    sides[i].covariance(0, 0) += std::pow(kLevelsDiffer * sides[i].blur, 2);
  }
  return sides;
}

/// Where side i − 1 ends and side i begins, with its standard deviation per axis.
std::pair<Vector2d, double> meet(const EdgeFit& before, const EdgeFit& after) {
  Eigen::Matrix2d N;
  N << before.normal.transpose(), after.normal.transpose();
  const Vector2d offset(before.normal.dot(before.point), after.normal.dot(after.point));
  const Eigen::Matrix2d inverse = N.inverse();
  const Vector2d corner = inverse * offset;
  const Eigen::Matrix2d S =
      inverse * Vector2d(before.varianceAt(corner), after.varianceAt(corner)).asDiagonal() *
      inverse.transpose();
  return {corner, std::sqrt(S.trace() / 2 + kFloor_px * kFloor_px)};
}

}  // namespace

std::optional<RefinedCorners> refineCorners(const ImageView& grey,
                                            const std::array<Vector2d, 4>& start_px,
                                            const CornerRefinement& options) {
  std::array<Vector2d, 4> corners = start_px;
  RefinedCorners refined;
  for (int pass = 0; pass < 3; ++pass) {
    const auto sides = fitSides(grey, corners, options);
    if (!sides) return std::nullopt;
    double moved = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [corner, sigma] = meet((*sides)[(i + 3) % 4], (*sides)[i]);
      if (!corner.allFinite()) return std::nullopt;
      moved = std::max(moved, (corner - corners[i]).norm());
      corners[i] = corner;
      refined.sigma_px[i] = sigma;
    }
    refined.blur_px = refined.contrast = 0;
    for (const EdgeFit& side : *sides) {
      refined.blur_px += side.blur / 4;
      refined.contrast += std::abs(side.contrast) / 4;
    }
    if (pass > 0 && moved < 0.05) break;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if ((corners[i] - start_px[i]).norm() > kMaxShift_px) return std::nullopt;
  }
  refined.px = corners;
  return refined;
}

}  // namespace slamscope::tracking
