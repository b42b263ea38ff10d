// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "apps/lib/view/alarm_marks.hpp"
#include "apps/lib/view/pair_thinning.hpp"
#include "apps/lib/view/palette.hpp"
#include "apps/lib/view/path_trace.hpp"
#include "engine/render/options.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/pair_glyphs.hpp"
#include "slam/clusters.hpp"
#include "slam/correlation.hpp"
#include "slam/correlation_pairs.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::apps {

/// Choices of the user and sizes that suit the view. Lengths are of the scene (m on the real
/// floor); the map is drawn at `map_scale`.
struct SceneStyle {
  slam::PairMode mode = slam::PairMode::all;
  slam::AxisScale axis{};
  std::vector<slam::FeatureId> selected{};  ///< for PairMode::selected
  PairThinning thinning{};
  PaletteName palette = PaletteName::paper;
  double map_scale = 1.0;
  bool covariance_rings = false;  ///< k-sigma ellipses of robot and features on the floor
  bool labels = true;             ///< feature ids
  double cone_height = 0.22;      ///< m
  double cone_radius = 0.028;     ///< m
  double arrow_length = 0.30;     ///< m
  /// Where "above" is for the viewer (the picture's up), in scene coordinates, unit length.
  Eigen::Vector3d viewer_up = Eigen::Vector3d::UnitZ();
};

/// What makes a glyph of a room-sized map visible: λ is in m², and 1 m a m² would be a speck.
[[nodiscard]] constexpr double defaultGain(slam::Axis axis) {
  return axis == slam::Axis::eigenvalue ? 25.0 : 1.0;
}

/// The features and their covariance as the device takes them; null where only the diagonal of P is
/// known.
[[nodiscard]] engine::PlanarPointsPtr pointsOf(const slam::Snapshot& snapshot);

/// Where a map has more pairs, their lines are left out: they would hide everything else. Where
/// more of them are flagged, their halos too.
inline constexpr std::size_t kMostPairLines = 1000;

/// What is to be shown of a moment.
struct Belief {
  const slam::Snapshot& snapshot;
  engine::PlanarPointsPtr points;  ///< pointsOf(snapshot), made once a snapshot
  const PathTrace& path;
  const slam::Clustering& clusters;                  ///< of this snapshot
  std::span<const slam::ClusterPair> cluster_pairs;  ///< of these, for mode min-mean-max
  const AlarmMarks& alarms;
};

/// A moment as glyphs, in the frame of the map scaled by `map_scale`: robot and features as cones
/// standing on their tips, heading arrow, path, and the relative covariances that the mode selects
/// as ellipsoids in the middle of their pair's line. Those of the modes all, between-clusters and
/// selected are made by the device (engine::PairGlyphs).
///
/// Tentative features are pale, with a question mark after their id, their pairs faint.
///
/// Every glyph's tag says what it stands for (GlyphMeaning). What the audit flags has a colour of
/// its own in every mode, in a faint halo of its last good size; mode
/// alarms shows no other features and pairs.
///
/// An ellipsoid's horizontal semi-axes are those of P_d by `axis`, the vertical one is as long as
/// the minor one (the paper's step against clutter). In mode min-mean-max the minimum stands
/// underneath and the maximum above the mean as the viewer sees it: from an overhead camera a
/// vertical stack would hide all but the top one.
[[nodiscard]] engine::Scene buildScene(const Belief& belief, const SceneStyle& style);

/// The k-sigma ellipse of a position with covariance P (m²) on the floor, all in the scene.
[[nodiscard]] engine::Polyline floorRing(const Eigen::Vector2d& centre, const Eigen::Matrix2d& P,
                                         double k, const engine::Rgba& colour,
                                         double width_px = 1.6);

/// How many relative covariances the scene shows: ellipsoids without halos, and what the device
/// chose when it drew the scene.
[[nodiscard]] std::size_t ellipsoidCount(const engine::Scene& scene,
                                         const engine::FrameStats::Pairs& drawn = {});

/// The ellipsoid for one relative covariance (m²), centred at `centre` (scene, m).
[[nodiscard]] engine::Ellipsoid relativeEllipsoid(const Eigen::Matrix2d& P_d,
                                                  const Eigen::Vector3d& centre,
                                                  const SceneStyle& style);

}  // namespace slamscope::apps
