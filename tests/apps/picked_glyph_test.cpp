// SPDX-License-Identifier: MIT
#include "apps/lib/view/picked_glyph.hpp"

#include <gtest/gtest.h>

#include "apps/lib/view/scene_builder.hpp"
#include "engine/scene/clip.hpp"
#include "slam/simulation.hpp"

namespace slamscope::apps {
namespace {

/// The paper's map from a corner of it, as the filter knows it at the end.
class PickedGlyph : public testing::Test {
 protected:
  PickedGlyph() {
    slam::Simulation simulation({.loops = 1});
    while (simulation.step()) {
    }
    snapshot_ = simulation.filter().snapshot();
    clusters_ = slam::ClusterTracker().update(snapshot_);
    path_.add({0.0, 0.0});
    path_.add(snapshot_.pose.head<2>());
    view_.camera = {.width = 960, .height = 540, .fx = 700, .fy = 700, .cx = 479.5, .cy = 269.5};
    const Eigen::Matrix3d R =
        (Eigen::Matrix3d() << 1, 0, 0, 0, -0.8, -0.6, 0, 0.6, -0.8).finished();
    view_.T_eye_scene.linear() = R;
    view_.T_eye_scene.translation() = -R * Eigen::Vector3d(0.5, -2.4, 3.6);
  }

  std::string clicked(const Eigen::Vector2d& pixel) {
    return whatIsAt(
        pixel, 0,
        {.offscreen = offscreen_, .scene = scene_, .snapshot = snapshot_, .alarms = alarms_});
  }
  void show(const SceneStyle& style) {
    const slam::PairSelection of_clusters =
        slam::selectPairs(snapshot_, slam::PairMode::min_mean_max, clusters_);
    scene_ = buildScene({.snapshot = snapshot_,
                         .points = pointsOf(snapshot_),
                         .path = path_,
                         .clusters = clusters_,
                         .cluster_pairs = of_clusters.cluster_pairs,
                         .alarms = alarms_},
                        style);
    (void)offscreen_.draw({&view_, 1}, scene_);
  }
  [[nodiscard]] Eigen::Vector2d pixelOf(const Eigen::Vector3d& p) const {
    return engine::project(view_.camera, view_.T_eye_scene * p);
  }
  /// The middle of a cone's lid.
  [[nodiscard]] Eigen::Vector2d lidOf(int k) const {
    const Eigen::Vector2d& f = snapshot_.features[std::size_t(k)];
    return pixelOf({f.x(), f.y(), 0.22});
  }

  slam::Snapshot snapshot_;
  slam::Clustering clusters_;
  PathTrace path_;
  AlarmMarks alarms_;
  engine::View view_;
  engine::Scene scene_;
  engine::Offscreen offscreen_{std::make_shared<engine::Gpu>(), 960, 540};
};

std::string firstWords(const std::string& text) {
  return text.substr(0, text.find(':'));
}

TEST_F(PickedGlyph, IsTheFeatureWhoseConeIsSeenThere) {
  show({});
  for (const int k : {0, 6, 12}) {
    EXPECT_EQ(firstWords(clicked(lidOf(k))), "feature " + std::to_string(snapshot_.ids[k]));
  }
  EXPECT_EQ(clicked({3.0, 3.0}), "nothing of the filter's there");
}

TEST_F(PickedGlyph, IsThePairWhoseEllipsoidIsSeenThere) {
  show({.axis = {.axis = slam::Axis::sigma, .k = 3.0, .gain = 2.0}});
  const Eigen::Vector2d middle = 0.5 * (snapshot_.features[2] + snapshot_.features[9]);
  const std::string text = clicked(pixelOf({middle.x(), middle.y(), 0.0}));
  EXPECT_EQ(text.substr(0, 9), "features ") << text;
  EXPECT_NE(text.find("relative"), std::string::npos) << text;
}

TEST_F(PickedGlyph, OfThreeThatStandForManyIsTheirMeanOrOnePair) {
  show({.mode = slam::PairMode::min_mean_max,
        .axis = {.axis = slam::Axis::sigma, .k = 3.0, .gain = 4.0}});
  ASSERT_EQ(scene_.ellipsoids.size(), 9U);
  EXPECT_EQ(firstWords(clicked(pixelOf(scene_.ellipsoids[1].centre))), "clusters 1 and 2");
  EXPECT_EQ(clicked(pixelOf(scene_.ellipsoids[2].centre)).substr(0, 9), "features ");
}

TEST_F(PickedGlyph, IsNotLookedForUnderPanels) {
  show({});
  scene_.rects.push_back({.min_px = {0, 0}, .max_px = {960, 540}, .colour = {}});
  EXPECT_EQ(clicked(lidOf(6)), "words lie over the map there");
}

}  // namespace
}  // namespace slamscope::apps
