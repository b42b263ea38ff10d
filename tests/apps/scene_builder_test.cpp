// SPDX-License-Identifier: MIT
#include "apps/lib/view/scene_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/lib/view/legend.hpp"
#include "slam/simulation.hpp"

namespace slamscope::apps {
namespace {

const Palette& kColours = paletteOf(PaletteName::paper);

struct Shown {
  slam::Snapshot snapshot;
  slam::Clustering clusters;
};

/// The paper's map as the filter knows it at the end.
Shown endOfRun() {
  slam::Simulation simulation({.loops = 1});
  while (simulation.step()) {
  }
  Shown shown{.snapshot = simulation.filter().snapshot(), .clusters = {}};
  slam::ClusterTracker tracker;
  shown.clusters = tracker.update(shown.snapshot);
  return shown;
}

engine::Scene sceneOf(const Shown& shown, const SceneStyle& style, const AlarmMarks& alarms = {}) {
  PathTrace path;
  path.add({0.0, 0.0});
  path.add(shown.snapshot.pose.head<2>());
  const slam::PairSelection of_clusters =
      slam::selectPairs(shown.snapshot, slam::PairMode::min_mean_max, shown.clusters);
  return buildScene({.snapshot = shown.snapshot,
                     .points = pointsOf(shown.snapshot),
                     .path = path,
                     .clusters = shown.clusters,
                     .cluster_pairs = of_clusters.cluster_pairs,
                     .alarms = alarms},
                    style);
}

/// Pairs that the device will choose, by the rules of engine::PairChoice.
std::size_t chosenPairs(const engine::Scene& scene) {
  const engine::PairChoice& choice = scene.pairs->choice;
  const auto picked = [&](std::uint32_t i) {
    return std::ranges::find(choice.touching, i) != choice.touching.end();
  };
  std::size_t count = 0;
  const auto n = static_cast<std::uint32_t>(scene.pairs->points->count());
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i + 1; j < n; ++j) {
      const bool different = choice.groups.empty() || choice.groups[i] != choice.groups[j];
      const bool touching = choice.touching.empty() || picked(i) || picked(j);
      count += different && touching ? 1 : 0;
    }
  }
  return count - choice.left_out.size();
}

TEST(SceneBuilder, AllPairsOfFifteenFeaturesAre105WithTheirLines) {
  const engine::Scene scene = sceneOf(endOfRun(), {.mode = slam::PairMode::all});
  ASSERT_TRUE(scene.pairs);
  EXPECT_EQ(chosenPairs(scene), 105U);
  EXPECT_TRUE(scene.ellipsoids.empty());
  EXPECT_EQ(scene.cones.size(), 16U);
  EXPECT_EQ(scene.arrows.size(), 1U);
  EXPECT_EQ(scene.lines.size(), 106U);  // and the path
}

TEST(SceneBuilder, ThinningIsLeftToTheDeviceAndLeavesTheLinesOut) {
  const engine::Scene scene = sceneOf(endOfRun(), {.thinning = {.most = 20, .least_area = 1e-4}});
  EXPECT_EQ(scene.pairs->choice.most, 20U);
  EXPECT_EQ(scene.pairs->choice.least_area, 1e-4);
  EXPECT_EQ(scene.lines.size(), 1U);  // the path
}

TEST(SceneBuilder, BetweenClustersLeavesOutPairsInsideThem) {
  const Shown shown = endOfRun();
  ASSERT_EQ(shown.clusters.count(), 3);
  std::size_t inside = 0;
  for (const auto& members : shown.clusters.members) {
    inside += members.size() * (members.size() - 1) / 2;
  }
  const engine::Scene scene = sceneOf(shown, {.mode = slam::PairMode::between_clusters});
  EXPECT_EQ(chosenPairs(scene), 105U - inside);
  EXPECT_EQ(scene.lines.size(), 106U - inside);
  EXPECT_GT(inside, 0U);
}

TEST(SceneBuilder, MinMeanMaxStandsUnderneathAndAboveTheMeanForTheViewer) {
  const Shown shown = endOfRun();
  const Eigen::Vector3d up = Eigen::Vector3d(0.0, 0.96, 0.28).normalized();
  const engine::Scene scene =
      sceneOf(shown, {.mode = slam::PairMode::min_mean_max, .viewer_up = up});
  ASSERT_EQ(scene.ellipsoids.size(), 9U);  // three pairs of clusters
  for (std::size_t k = 0; k < 9; k += 3) {
    const double low = up.dot(scene.ellipsoids[k].centre);
    const double middle = up.dot(scene.ellipsoids[k + 1].centre);
    const double high = up.dot(scene.ellipsoids[k + 2].centre);
    EXPECT_LT(low, middle);
    EXPECT_LT(middle, high);
    EXPECT_EQ(scene.ellipsoids[k + 1].centre.z(), 0.0);
    // The least is the smallest: √det of the horizontal block.
    const auto area = [&](std::size_t index) {
      return std::abs(scene.ellipsoids[index].axes.topLeftCorner<2, 2>().determinant());
    };
    EXPECT_LT(area(k), area(k + 2));
  }
}

TEST(SceneBuilder, SelectedShowsThePairsOfThePickedFeatureOnly) {
  const Shown shown = endOfRun();
  const engine::Scene scene = sceneOf(shown, {.mode = slam::PairMode::selected, .selected = {3}});
  EXPECT_EQ(chosenPairs(scene), 14U);
  EXPECT_EQ(scene.lines.size(), 15U);
  // One that is not in the map has no pairs; it does not stand for no condition.
  const engine::Scene none = sceneOf(shown, {.mode = slam::PairMode::selected, .selected = {99}});
  EXPECT_EQ(chosenPairs(none), 0U);
}

/// Feature 3 is flagged, with all its pairs, which had `last_good` before.
AlarmMarks thirdFlagged(const Shown& shown, const Eigen::Matrix2d& last_good) {
  Judgement judgement;
  judgement.alarms.features = {{.feature = 3, .last_good = last_good}};
  for (const slam::FeatureId other : shown.snapshot.ids) {
    if (other == 3) continue;
    judgement.alarms.pairs.push_back(
        {std::min<slam::FeatureId>(3, other), std::max<slam::FeatureId>(3, other), last_good});
  }
  return AlarmMarks(judgement);
}

bool alike(const engine::Rgba& a, const engine::Rgba& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a;
}

template <typename Glyphs>
std::ptrdiff_t count(const Glyphs& glyphs, const engine::Rgba& hue) {
  return std::count_if(glyphs.begin(), glyphs.end(),
                       [&](const auto& glyph) { return alike(glyph.colour, hue); });
}

TEST(SceneBuilder, AlarmsShowFlaggedFeaturesAndPairsOnlyEachInItsHalo) {
  const Shown shown = endOfRun();
  const Eigen::Matrix2d last_good = Eigen::Vector2d(0.04, 0.01).asDiagonal();
  const AlarmMarks alarms = thirdFlagged(shown, last_good);
  const engine::Scene scene = sceneOf(shown, {.mode = slam::PairMode::alarms}, alarms);
  EXPECT_EQ(scene.cones.size(), 2U);  // the robot's, and feature 3's
  EXPECT_EQ(count(scene.cones, kColours.flagged), 1);
  EXPECT_EQ(scene.labels.size(), 1U);
  EXPECT_EQ(ellipsoidCount(scene), 14U);
  EXPECT_EQ(count(scene.ellipsoids, kColours.flagged_ellipsoid), 14);
  ASSERT_EQ(count(scene.ellipsoids, kColours.halo), 14);
  for (const engine::Ellipsoid& halo : scene.ellipsoids) {
    if (!alike(halo.colour, kColours.halo)) continue;
    EXPECT_NEAR(halo.axes.col(0).norm(), 3.0 * 0.2, 1e-12);
    EXPECT_NEAR(halo.axes.col(1).norm(), 3.0 * 0.1, 1e-12);
  }
  EXPECT_EQ(count(scene.lines, kColours.halo_ring), 1);
}

TEST(SceneBuilder, VeryManyFlaggedPairsAreThoseOfTheFlaggedFeaturesByTheDevice) {
  Shown shown{.snapshot = {}, .clusters = {}};
  constexpr int kCount = 60;
  shown.snapshot.covariance = slam::PackedCovariance(3 + 2 * kCount);
  Judgement judgement;
  for (int k = 0; k < kCount; ++k) {
    const auto id = static_cast<slam::FeatureId>(k);
    shown.snapshot.ids.push_back(id);
    shown.snapshot.features.emplace_back(0.1 * k, 0.0);
    if (k % 2 == 0) judgement.alarms.features.push_back({.feature = id, .last_good = {}});
    for (slam::FeatureId other = 0; other < id; ++other) {
      if (k % 2 == 0 || other % 2 == 0) judgement.alarms.pairs.push_back({other, id, {}});
    }
  }
  ASSERT_GT(judgement.alarms.pairs.size(), kMostPairLines);
  shown.clusters = slam::clusterAt(shown.snapshot.features, 1.0);
  const engine::Scene scene =
      sceneOf(shown, {.mode = slam::PairMode::alarms}, AlarmMarks(judgement));
  ASSERT_TRUE(scene.pairs);
  EXPECT_EQ(chosenPairs(scene), judgement.alarms.pairs.size());
  EXPECT_TRUE(alike(scene.pairs->colour, kColours.flagged));
  EXPECT_TRUE(scene.ellipsoids.empty());
}

TEST(SceneBuilder, FlaggedIsMagentaInEveryModeAndNothingElseIs) {
  const Shown shown = endOfRun();
  const AlarmMarks alarms = thirdFlagged(shown, Eigen::Matrix2d::Identity());
  const engine::Scene scene = sceneOf(shown, {.mode = slam::PairMode::all}, alarms);
  EXPECT_EQ(ellipsoidCount(scene), 14U);
  EXPECT_EQ(count(scene.ellipsoids, kColours.flagged_ellipsoid), 14);
  EXPECT_EQ(chosenPairs(scene), 105U - 14U);
  EXPECT_EQ(count(scene.lines, kColours.flagged_pair), 14);
  EXPECT_EQ(scene.cones.size(), 16U);
  EXPECT_EQ(count(scene.cones, kColours.flagged), 1);

  const engine::Scene summary = sceneOf(shown, {.mode = slam::PairMode::min_mean_max}, alarms);
  EXPECT_EQ(ellipsoidCount(summary), 9U);

  // Twin: without alarms nothing is.
  const engine::Scene healthy = sceneOf(shown, {.mode = slam::PairMode::all});
  EXPECT_EQ(count(healthy.ellipsoids, kColours.flagged_ellipsoid), 0);
  EXPECT_EQ(count(healthy.cones, kColours.flagged), 0);
  EXPECT_TRUE(sceneOf(shown, {.mode = slam::PairMode::alarms}).ellipsoids.empty());
}

TEST(SceneBuilder, TentativeFeaturesArePaleWithAQuestionMarkAndTheirPairsFaint) {
  Shown shown = endOfRun();
  shown.snapshot.tentative = {shown.snapshot.ids[3]};
  const engine::Scene scene = sceneOf(shown, {.mode = slam::PairMode::all});
  const auto count = [](const auto& glyphs, const engine::Rgba& hue) {
    return std::count_if(glyphs.begin(), glyphs.end(), [&](const auto& glyph) {
      return glyph.colour.r == hue.r && glyph.colour.g == hue.g && glyph.colour.a == hue.a;
    });
  };
  EXPECT_EQ(count(scene.cones, kColours.tentative), 1);
  EXPECT_EQ(count(scene.cones, kColours.feature), 14);
  EXPECT_EQ(count(scene.ellipsoids, kColours.tentative_ellipsoid), 14);
  EXPECT_EQ(count(scene.lines, kColours.tentative_pair), 14);
  EXPECT_EQ(scene.pairs->choice.left_out.size(), 14U);  // the device draws the others
  EXPECT_EQ(scene.labels[3].text, std::to_string(shown.snapshot.ids[3]) + "?");
  EXPECT_EQ(scene.labels[4].text, std::to_string(shown.snapshot.ids[4]));
}

TEST(SceneBuilder, AxesAreThoseOfTheRelativeCovariance) {
  Eigen::Matrix2d P_d;
  P_d << 0.04, 0.012, 0.012, 0.01;
  const engine::Ellipsoid ellipsoid = relativeEllipsoid(
      P_d, Eigen::Vector3d::Zero(), {.axis = {.axis = slam::Axis::sigma, .k = 2.0, .gain = 1.0}});
  const Eigen::Matrix2d axes = ellipsoid.axes.topLeftCorner<2, 2>();
  EXPECT_LT((axes * axes.transpose() - 4.0 * P_d).norm(), 1e-14);
  // The third axis is as long as the minor one.
  EXPECT_NEAR(ellipsoid.axes(2, 2), ellipsoid.axes.col(1).norm(), 1e-15);
  // Twin: another k is another ellipsoid.
  EXPECT_GT((axes * axes.transpose() - 9.0 * P_d).norm(), 1e-2);
}

TEST(SceneBuilder, MapScaleScalesPlacesAndAxesAlike) {
  const Shown shown = endOfRun();
  const engine::Scene all = sceneOf(shown, {.map_scale = 0.1});
  EXPECT_EQ(all.pairs->scale, 0.1);
  EXPECT_NEAR(all.pairs->axis.gain, 0.1 * 3.0, 1e-12);
  const auto mode = slam::PairMode::min_mean_max;
  const engine::Scene full = sceneOf(shown, {.mode = mode, .viewer_up = {0, 0, 1}});
  const engine::Scene tenth =
      sceneOf(shown, {.mode = mode, .map_scale = 0.1, .viewer_up = {0, 0, 1}});
  ASSERT_EQ(full.ellipsoids.size(), tenth.ellipsoids.size());
  for (std::size_t k = 0; k < full.ellipsoids.size(); ++k) {
    EXPECT_LT((0.1 * full.ellipsoids[k].centre - tenth.ellipsoids[k].centre).norm(), 1e-12);
    EXPECT_LT((0.1 * full.ellipsoids[k].axes - tenth.ellipsoids[k].axes).norm(), 1e-12);
  }
}

TEST(Legend, BarStandsForTheEigenvalueThatIsDrawnSoLong) {
  for (const slam::Axis kind : {slam::Axis::sigma, slam::Axis::eigenvalue, slam::Axis::log}) {
    const slam::AxisScale axis{.axis = kind, .k = 3.0, .gain = 7.0};
    for (const double length : {0.002, 0.1, 0.5}) {
      EXPECT_NEAR(axis.semiAxis(eigenvalueOfLength(axis, length)), length, 1e-9 * length);
    }
  }
}

TEST(Legend, RoundLengthsAreOneTwoFive) {
  EXPECT_DOUBLE_EQ(roundLength(1.0), 1.0);
  EXPECT_DOUBLE_EQ(roundLength(0.99), 0.5);
  EXPECT_DOUBLE_EQ(roundLength(0.37), 0.2);
  EXPECT_DOUBLE_EQ(roundLength(73.0), 50.0);
}

}  // namespace
}  // namespace slamscope::apps
