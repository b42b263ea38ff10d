// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/scene/glyphs.hpp"
#include "engine/scene/planar_points.hpp"

// Pairs of points as ellipsoids that the device makes itself, out of one covariance.
namespace slamscope::engine {

/// Length of a semi-axis for an eigenvalue λ (m²) of a covariance.
struct AxisLaw {
  enum class Kind : std::uint32_t {
    root,         ///< gain · √λ
    linear,       ///< gain · λ
    logarithmic,  ///< gain · log10(1 + √λ / unit)
  };
  Kind kind = Kind::root;
  double gain = 1.0;
  double unit = 1.0;  ///< m
};

/// By what pairs come first.
enum class MostBy : std::uint32_t {
  area,         ///< √det of the pair's covariance, the greatest
  growth,       ///< its ratio to what it was when these points were first drawn ranked so
  last_growth,  ///< its ratio to what it was with the points that were drawn before
};

/// Which pairs are drawn: those that meet every condition.
struct PairChoice {
  /// One number a point; a pair whose points have the same is not drawn. Empty: no condition.
  std::vector<std::uint32_t> groups = {};
  /// By index; a pair that touches none of them is not drawn. Empty: no condition.
  std::vector<std::uint32_t> touching = {};
  /// m², √det of the pair's covariance; smaller ones are not drawn.
  double least_area = 0.0;
  /// So many that come first by `most_by` (and those that are even with the last); 0: all.
  std::uint32_t most = 0;
  MostBy most_by = MostBy::area;
  /// Only pairs both of whose points are in the picture of one view.
  bool in_view = false;
  /// By index, in any order of the two: what something else draws.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> left_out = {};

  bool operator==(const PairChoice&) const = default;
};

/// For each chosen pair (i, j) of points an ellipsoid in the middle between the two, for the
/// covariance P_d = P_ii + P_jj − P_ij − P_ji of their difference: two axes in the plane along its
/// eigenvectors, the third upright and as long as the shorter of them. All of it is computed on the
/// device from one upload of the points.
///
/// Opaque ones (colour.a · RenderOptions::opacity = 1) hide what is behind them; translucent ones
/// fade as one layer: of several behind one another only the nearest is seen, whatever their order.
/// Edges are smooth over what lies behind. In both ways of drawing (PairWay) alike, but for pixels
/// at which the edges of several glyphs meet: splatting shows the nearest of those edges only.
struct PairGlyphs {
  PlanarPointsPtr points;  ///< none: nothing is drawn
  double scale = 1.0;      ///< of the points' places: m of the scene for 1 m; z = 0, x to x, y to y
  AxisLaw axis;            ///< in m of the scene
  PairChoice choice;
  Rgba colour;
};

}  // namespace slamscope::engine
