// SPDX-License-Identifier: MIT
#include "apps/lib/view/scene_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "apps/lib/view/glyph_meaning.hpp"

namespace slamscope::apps {
namespace {

using What = GlyphMeaning::What;

std::uint64_t tagOf(What what, int i = 0, int j = 0) {
  return GlyphMeaning{
      .what = what, .i = static_cast<std::uint32_t>(i), .j = static_cast<std::uint32_t>(j)}
      .tag();
}
std::uint64_t tagOf(What what, const slam::FeaturePair& pair) {
  return tagOf(what, pair.i, pair.j);
}

/// The length of a semi-axis as slam::AxisScale has it, in m of the scene.
engine::AxisLaw axisLaw(const SceneStyle& style) {
  const double gain = style.map_scale * style.axis.gain;
  switch (style.axis.axis) {
    case slam::Axis::eigenvalue:
      return {.kind = engine::AxisLaw::Kind::linear, .gain = gain};
    case slam::Axis::log:
      return {.kind = engine::AxisLaw::Kind::logarithmic,
              .gain = 0.1 * gain,
              .unit = 1e-3 / style.axis.k};
    case slam::Axis::sigma:
      break;
  }
  return {.kind = engine::AxisLaw::Kind::root, .gain = gain * style.axis.k};
}

/// Builds one scene; holds what every part of it needs.
class SceneBuilder {
 public:
  SceneBuilder(const Belief& belief, const SceneStyle& style)
      : belief_(belief),
        snapshot_(belief.snapshot),
        alarms_(belief.alarms),
        style_(style),
        colours_(paletteOf(style.palette)) {}

  void addRobot(const PathTrace& path) {
    engine::Polyline trace{
        .points = {}, .width_px = 2.5, .colour = colours_.robot, .tag = tagOf(What::path)};
    for (const Eigen::Vector2d& point : path.points()) trace.points.push_back(onFloor(point));
    if (trace.points.size() > 1) scene_.lines.push_back(std::move(trace));

    const Eigen::Vector3d position = onFloor(snapshot_.pose.head<2>());
    scene_.cones.push_back(cone(position, colours_.robot, tagOf(What::robot)));
    scene_.arrows.push_back({.origin = position,
                             .heading = snapshot_.pose.z(),
                             .length = style_.arrow_length,
                             .width = 0.36 * style_.arrow_length,
                             .colour = colours_.heading,
                             .tag = tagOf(What::robot)});
    if (style_.covariance_rings) {
      addRing(snapshot_.pose.head<2>(), snapshot_.covariance.block2(0, 0), colours_.robot,
              tagOf(What::robot));
    }
  }

  void addFeatures() {
    for (int k = 0; k < snapshot_.featureCount(); ++k) {
      const AlarmMarks::Mark* mark = alarms_.feature(id(k));
      if (style_.mode == slam::PairMode::alarms && mark == nullptr) continue;
      const engine::Rgba& hue = mark != nullptr  ? colours_.flagged
                                : isTentative(k) ? colours_.tentative
                                                 : colours_.feature;
      const Eigen::Vector2d& feature = snapshot_.features[static_cast<std::size_t>(k)];
      scene_.cones.push_back(cone(onFloor(feature), hue, tagOf(What::feature, k)));
      if (style_.covariance_rings || (mark != nullptr && mark->last_good)) {
        const int row = slam::Snapshot::row(k);
        addRing(feature, snapshot_.covariance.block2(row, row), hue, tagOf(What::feature, k));
      }
      if (mark != nullptr && mark->last_good) {
        addRing(feature, *mark->last_good, colours_.halo_ring, tagOf(What::feature, k), 4.0);
      }
      if (!style_.labels) continue;
      scene_.labels.push_back({.anchor = onFloor(feature),
                               .text = std::to_string(id(k)) + (isTentative(k) ? "?" : ""),
                               .colour = {1.0F, 1.0F, 1.0F, 1.0F}});
    }
  }

  void addPair(const slam::FeaturePair& pair) {
    const Eigen::Vector3d from = featureOnFloor(pair.i);
    const Eigen::Vector3d to = featureOnFloor(pair.j);
    const bool flagged = alarms_.pair(id(pair.i), id(pair.j)) != nullptr;
    if (!flagged || !manyFlagged()) {
      addLine(from, to,
              flagged            ? colours_.flagged_pair
              : isDoubtful(pair) ? colours_.tentative_pair
                                 : colours_.pair,
              tagOf(What::pair, pair));
    }
    addEllipsoid(pair, relativeEllipsoid(pair.P_d, 0.5 * (from + to), style_));
  }

  /// The pairs of the mode, by the device; apart those that are flagged, for they have colours and
  /// halos of their own, and where pairs can be told apart those of tentative features.
  void addPairsOnDevice() {
    if (!belief_.points) return;
    engine::PairGlyphs glyphs = glyphsOf(choice(), colours_.ellipsoid);
    addEachFlaggedPair(glyphs.choice);
    if (style_.thinning.none() && belief_.points->pairCount() <= kMostPairLines) {
      addPairLines();
      addDoubtfulPairs(glyphs.choice);
    }
    scene_.pairs = std::make_shared<engine::PairGlyphs>(std::move(glyphs));
  }

  /// The flagged pairs alone; very many, which go without lines and halos, by the device.
  void addFlaggedPairs() {
    engine::PairChoice choice;
    if (!manyFlagged()) return addEachFlaggedPair(choice);
    if (!belief_.points) return;
    choice.touching = indicesOf(alarms_.blamed());
    scene_.pairs = std::make_shared<engine::PairGlyphs>(glyphsOf(choice, colours_.flagged));
  }

  void addClusterPair(const slam::ClusterPair& pair) {
    const Eigen::Vector3d from = onFloor(pair.centroid_a);
    const Eigen::Vector3d to = onFloor(pair.centroid_b);
    addLine(from, to, colours_.pair, tagOf(What::mean, pair.a, pair.b));
    const Eigen::Vector3d middle = 0.5 * (from + to);
    engine::Ellipsoid mean = relativeEllipsoid(pair.mean, middle, style_);
    mean.tag = tagOf(What::mean, pair.a, pair.b);
    engine::Ellipsoid minimum = relativeEllipsoid(pair.minimum.P_d, middle, style_);
    engine::Ellipsoid maximum = relativeEllipsoid(pair.maximum.P_d, middle, style_);
    constexpr double kGap = 1.08;  // of the touching distance
    minimum.centre -= kGap * (reach(mean) + reach(minimum)) * style_.viewer_up;
    maximum.centre += kGap * (reach(mean) + reach(maximum)) * style_.viewer_up;
    addEllipsoid(pair.minimum, minimum);
    scene_.ellipsoids.push_back(mean);
    addEllipsoid(pair.maximum, maximum);
  }

  [[nodiscard]] engine::Scene take() { return std::move(scene_); }

 private:
  [[nodiscard]] engine::PairGlyphs glyphsOf(const engine::PairChoice& choice,
                                            const engine::Rgba& colour) const {
    return {.points = belief_.points,
            .scale = style_.map_scale,
            .axis = axisLaw(style_),
            .choice = choice,
            .colour = colour};
  }

  /// For PairChoice::touching: one that no point has where none of them is in the map, as no
  /// condition would mean all pairs.
  [[nodiscard]] std::vector<std::uint32_t> indicesOf(std::span<const slam::FeatureId> ids) const {
    std::vector<std::uint32_t> indices;
    for (const slam::FeatureId wanted : ids) {
      if (const auto k = snapshot_.indexOf(wanted)) {
        indices.push_back(static_cast<std::uint32_t>(*k));
      }
    }
    if (indices.empty()) indices.push_back(~0U);
    return indices;
  }

  [[nodiscard]] bool manyFlagged() const { return alarms_.pairs().size() > kMostPairLines; }

  /// The flagged pairs that the mode shows; `others` are without them.
  void addEachFlaggedPair(engine::PairChoice& others) {
    if (snapshot_.diagonal_only) return;
    for (const AlarmMarks::Pair& pair : alarms_.pairs()) {
      const auto i = snapshot_.indexOf(pair.first);
      const auto j = snapshot_.indexOf(pair.second);
      if (!i || !j || i == j || !shown(*i, *j)) continue;
      others.left_out.emplace_back(*i, *j);
      addPair({std::min(*i, *j), std::max(*i, *j), slam::relativeCovariance(snapshot_, *i, *j)});
    }
  }

  /// Whether the mode shows this pair.
  [[nodiscard]] bool shown(int i, int j) const {
    if (style_.mode == slam::PairMode::between_clusters) {
      const std::vector<int>& label = belief_.clusters.label;
      return label[static_cast<std::size_t>(i)] != label[static_cast<std::size_t>(j)];
    }
    if (style_.mode != slam::PairMode::selected) return true;
    const auto picked = [this](int k) {
      return std::ranges::find(style_.selected, id(k)) != style_.selected.end();
    };
    return picked(i) || picked(j);
  }

  /// Shown, and not flagged.
  [[nodiscard]] bool plain(int i, int j) const {
    return shown(i, j) && alarms_.pair(id(i), id(j)) == nullptr;
  }

  [[nodiscard]] engine::PairChoice choice() const {
    engine::PairChoice choice{.least_area = style_.thinning.least_area,
                              .most = style_.thinning.most,
                              .most_by = style_.thinning.by,
                              .in_view = style_.thinning.in_view};
    if (style_.mode == slam::PairMode::between_clusters) {
      for (const int label : belief_.clusters.label) {
        choice.groups.push_back(static_cast<std::uint32_t>(label));
      }
    }
    if (style_.mode == slam::PairMode::selected) {
      choice.touching = indicesOf(style_.selected);
    }
    return choice;
  }

  void addPairLines() {
    for (int i = 0; i < snapshot_.featureCount(); ++i) {
      for (int j = i + 1; j < snapshot_.featureCount(); ++j) {
        if (!plain(i, j) || isTentative(i) || isTentative(j)) continue;
        addLine(featureOnFloor(i), featureOnFloor(j), colours_.pair, tagOf(What::pair, i, j));
      }
    }
  }

  void addDoubtfulPairs(engine::PairChoice& choice) {
    for (int i = 0; i < snapshot_.featureCount(); ++i) {
      for (int j = i + 1; j < snapshot_.featureCount(); ++j) {
        if (!plain(i, j) || !(isTentative(i) || isTentative(j))) continue;
        choice.left_out.emplace_back(i, j);
        addPair({i, j, slam::relativeCovariance(snapshot_, i, j)});
      }
    }
  }

  [[nodiscard]] Eigen::Vector3d featureOnFloor(int index) const {
    return onFloor(snapshot_.features[static_cast<std::size_t>(index)]);
  }
  [[nodiscard]] slam::FeatureId id(int index) const {
    return snapshot_.ids[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] bool isTentative(int index) const { return snapshot_.isTentative(id(index)); }
  [[nodiscard]] bool isDoubtful(const slam::FeaturePair& pair) const {
    return isTentative(pair.i) || isTentative(pair.j);
  }
  [[nodiscard]] Eigen::Vector3d onFloor(const Eigen::Vector2d& p_map) const {
    return {style_.map_scale * p_map.x(), style_.map_scale * p_map.y(), 0.0};
  }
  [[nodiscard]] engine::Cone cone(const Eigen::Vector3d& tip, const engine::Rgba& colour,
                                  std::uint64_t tag) const {
    return {.tip = tip,
            .height = style_.cone_height,
            .radius = style_.cone_radius,
            .colour = colour,
            .tag = tag};
  }
  /// Half the ellipsoid's height as the viewer sees it.
  [[nodiscard]] double reach(const engine::Ellipsoid& ellipsoid) const {
    return (ellipsoid.axes.transpose() * style_.viewer_up).norm();
  }
  void addLine(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const engine::Rgba& hue,
               std::uint64_t tag) {
    scene_.lines.push_back({.points = {from, to}, .width_px = 1.1, .colour = hue, .tag = tag});
  }

  /// The pair's ellipsoid; in the flags' colour and, unless they are many, in its halo where the
  /// pair is flagged.
  void addEllipsoid(const slam::FeaturePair& pair, engine::Ellipsoid ellipsoid) {
    ellipsoid.tag = tagOf(What::pair, pair);
    if (isDoubtful(pair)) ellipsoid.colour = colours_.tentative_ellipsoid;
    if (const AlarmMarks::Mark* mark = alarms_.pair(id(pair.i), id(pair.j))) {
      ellipsoid.colour = colours_.flagged_ellipsoid;
      if (mark->last_good && !manyFlagged()) {
        engine::Ellipsoid halo = relativeEllipsoid(*mark->last_good, ellipsoid.centre, style_);
        halo.colour = colours_.halo;
        halo.tag = tagOf(What::halo, pair);
        scene_.ellipsoids.push_back(halo);
      }
    }
    scene_.ellipsoids.push_back(ellipsoid);
  }

  /// The k-sigma ellipse of a position's covariance P (m², map), as an outline on the floor.
  void addRing(const Eigen::Vector2d& centre, const Eigen::Matrix2d& P, const engine::Rgba& colour,
               std::uint64_t tag, double width_px = 1.6) {
    const double scale = style_.map_scale;
    engine::Polyline ring =
        floorRing(scale * centre, scale * scale * P, style_.axis.k, colour, width_px);
    ring.tag = tag;
    scene_.lines.push_back(std::move(ring));
  }

  const Belief& belief_;
  const slam::Snapshot& snapshot_;
  const AlarmMarks& alarms_;
  const SceneStyle& style_;
  const Palette& colours_;
  engine::Scene scene_;
};

}  // namespace

engine::Ellipsoid relativeEllipsoid(const Eigen::Matrix2d& P_d, const Eigen::Vector3d& centre,
                                    const SceneStyle& style) {
  const slam::PrincipalAxes principal = slam::principalAxes(P_d);
  const Eigen::Matrix2d directions = principal.directions();
  const double major = style.map_scale * style.axis.semiAxis(principal.eigenvalues.x());
  const double minor = style.map_scale * style.axis.semiAxis(principal.eigenvalues.y());
  engine::Ellipsoid ellipsoid{.centre = centre,
                              .axes = Eigen::Matrix3d::Zero(),
                              .colour = paletteOf(style.palette).ellipsoid};
  ellipsoid.axes.block<2, 1>(0, 0) = major * directions.col(0);
  ellipsoid.axes.block<2, 1>(0, 1) = minor * directions.col(1);
  ellipsoid.axes(2, 2) = minor;
  return ellipsoid;
}

engine::Polyline floorRing(const Eigen::Vector2d& centre, const Eigen::Matrix2d& P, double k,
                           const engine::Rgba& colour, double width_px) {
  constexpr int kPieces = 48;
  const slam::PrincipalAxes axes = slam::principalAxes(P);
  const Eigen::Vector2d semi = k * axes.eigenvalues.cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix2d directions = axes.directions();
  engine::Polyline ring{.points = {}, .width_px = width_px, .colour = colour};
  for (int piece = 0; piece <= kPieces; ++piece) {
    const double angle = 2.0 * std::numbers::pi * piece / kPieces;
    const Eigen::Vector2d on_ring(semi.x() * std::cos(angle), semi.y() * std::sin(angle));
    const Eigen::Vector2d point = centre + directions * on_ring;
    ring.points.emplace_back(point.x(), point.y(), 0.0);
  }
  return ring;
}

engine::PlanarPointsPtr pointsOf(const slam::Snapshot& snapshot) {
  if (snapshot.diagonal_only) return nullptr;
  return std::make_shared<engine::PlanarPoints>(snapshot.features, snapshot.covariance.packed(),
                                                slam::Snapshot::row(0), snapshot.ids);
}

std::size_t ellipsoidCount(const engine::Scene& scene, const engine::FrameStats::Pairs& drawn) {
  const auto own = std::count_if(
      scene.ellipsoids.begin(), scene.ellipsoids.end(),
      [](const engine::Ellipsoid& e) { return GlyphMeaning::ofTag(e.tag).what != What::halo; });
  return static_cast<std::size_t>(own) + drawn.chosen - drawn.not_finite;
}

engine::Scene buildScene(const Belief& belief, const SceneStyle& style) {
  SceneBuilder builder(belief, style);
  builder.addRobot(belief.path);
  builder.addFeatures();
  if (style.mode != slam::PairMode::min_mean_max && style.mode != slam::PairMode::alarms) {
    builder.addPairsOnDevice();
    return builder.take();
  }
  if (style.mode == slam::PairMode::min_mean_max) {
    for (const slam::ClusterPair& pair : belief.cluster_pairs) builder.addClusterPair(pair);
  } else {
    builder.addFlaggedPairs();
  }
  return builder.take();
}

}  // namespace slamscope::apps
