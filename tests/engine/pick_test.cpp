// SPDX-License-Identifier: MIT
#include <map>

#include "engine/scene/clip.hpp"
#include "engine/scene/pair_ellipsoid.hpp"
#include "tests/engine/pair_scene.hpp"
#include "tests/engine/reference_raycaster.hpp"

// What is said to be at a pixel is what the pixel shows, whichever way it was drawn.
namespace slamscope::engine {
namespace {

constexpr Pinhole kSmallCamera = {
    .width = 160, .height = 120, .fx = 150.0, .fy = 155.0, .cx = 78.2, .cy = 60.9, .skew = 2.5};

View overSmallFloor(double roll = 0.1) {
  return lookingAt(kSmallCamera, {0.1, -1.6, 1.4}, {0.05, 0.0, 0.0}, roll);
}

/// Names of what a reference picture's ids stand for.
struct Expected {
  Scene solids;  ///< all as ellipsoids and cones
  std::vector<Picked> names;
};

/// Pairs with ellipsoids and cones between them.
struct Crowd {
  Scene scene;
  Expected expected;

  explicit Crowd(int points) {
    const PairGlyphs glyphs = someMap(points, 0.07);
    scene.pairs = std::make_shared<PairGlyphs>(glyphs);
    scene.ellipsoids = {{{0.2, 0.1, 0.05}, 0.12 * Eigen::Matrix3d::Identity(), kWhite, 71},
                        {{-0.3, -0.1, 0.1}, 0.08 * Eigen::Matrix3d::Identity(), kWhite, 72}};
    scene.cones = {{.tip = {0.1, -0.3, 0.0}, .height = 0.4, .radius = 0.1, .tag = 81},
                   {.tip = {-0.1, 0.3, 0.0}, .height = 0.3, .radius = 0.06, .tag = 82}};
    expected.solids.cones = scene.cones;
    expected.solids.ellipsoids = scene.ellipsoids;
    for (const Ellipsoid& e : scene.ellipsoids) {
      expected.names.push_back({.kind = Picked::Kind::ellipsoid, .tag = e.tag});
    }
    for (std::uint32_t j = 1; j < std::uint32_t(points); ++j) {
      for (std::uint32_t i = 0; i < j; ++i) {
        expected.solids.ellipsoids.push_back(pairEllipsoid(glyphs, i, j));
        expected.names.push_back({.kind = Picked::Kind::pair, .i = i, .j = j});
      }
    }
    for (const Cone& c : scene.cones) {
      expected.names.push_back({.kind = Picked::Kind::cone, .tag = c.tag});
    }
  }
};

bool same(const std::optional<Picked>& a, const std::optional<Picked>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->kind == b->kind && a->tag == b->tag && a->i == b->i && a->j == b->j;
}

class PickedPixels : public PairTest, public ::testing::WithParamInterface<PairWay> {
 protected:
  struct Count {
    int asked = 0, wrong = 0;
    std::map<Picked::Kind, int> kinds;
  };

  /// At every third pixel that has no border within a pixel, against rays in double precision.
  Count compare(const Expected& expected, const View& view, std::uint32_t eye) {
    const reference::FinePicture reference(expected.solids, view);
    Count count;
    for (int v = 1; v < view.camera.height; v += 3) {
      for (int u = 1; u < view.camera.width; u += 3) {
        if (reference.nearEdge(u, v)) continue;
        const int id = reference.at(u, v).id;
        std::optional<Picked> wanted;
        if (id >= 0) wanted = expected.names[static_cast<std::size_t>(id)];
        const auto found = offscreen(eye > 0 ? 2 : 1).pick({.view = eye, .pixel = {u, v}});
        ++count.asked;
        count.wrong += same(found, wanted) ? 0 : 1;
        if (found) ++count.kinds[found->kind];
      }
    }
    return count;
  }
  [[nodiscard]] static RenderOptions options(bool lit = true) {
    return {.lit = lit, .pair_way = GetParam()};
  }
};

INSTANTIATE_TEST_SUITE_P(Ways, PickedPixels, ::testing::Values(PairWay::quads, PairWay::splats),
                         [](const auto& way) {
                           return way.param == PairWay::quads ? "Quads" : "Splats";
                         });

TEST_P(PickedPixels, AreOfTheNearestGlyphOfWhateverKind) {
  const Crowd crowd(9);
  const View view = overSmallFloor();
  (void)draw(view, crowd.scene, options());
  EXPECT_EQ(stats_.pairs.splatted, GetParam() == PairWay::splats);
  const Count count = compare(crowd.expected, view, 0);
  EXPECT_GT(count.asked, 700);
  EXPECT_EQ(count.wrong, 0);
  EXPECT_GT(count.kinds.at(Picked::Kind::pair), 100);
  EXPECT_GT(count.kinds.at(Picked::Kind::ellipsoid), 5);
  EXPECT_GT(count.kinds.at(Picked::Kind::cone), 5);
  // Twin: the reference of a head that is turned.
  EXPECT_GT(compare(crowd.expected, overSmallFloor(0.4), 0).wrong, 20);
}

TEST_P(PickedPixels, AreThoseOfTheEyeThatIsAskedFor) {
  const Crowd crowd(7);
  std::array views{overSmallFloor(), overSmallFloor()};
  views[1].T_eye_scene.translation().x() -= 0.2;
  (void)draw(views, crowd.scene, options());
  EXPECT_EQ(compare(crowd.expected, views[1], 1).wrong, 0);
  EXPECT_GT(compare(crowd.expected, views[0], 1).wrong, 20);
}

TEST_P(PickedPixels, LeaveThePictureAsItWas) {
  const Crowd crowd(9);
  const View view = overSmallFloor();
  const Image before = draw(view, crowd.scene, options());
  (void)offscreen(1).pick({.pixel = {80, 60}, .reach_px = 5});
  EXPECT_TRUE(sameBytes(before, draw(view, crowd.scene, options())));
}

TEST_P(PickedPixels, HaveNothingWhereNothingIsOrAllHasFaded) {
  Crowd crowd(9);
  const View view = overSmallFloor();
  (void)draw(view, crowd.scene, {.opacity = 0.0F, .pair_way = GetParam()});
  EXPECT_FALSE(offscreen(1).pick({.pixel = {80, 60}, .reach_px = 20}));
  (void)draw(view, crowd.scene, {.opacity = 0.3F, .pair_way = GetParam()});
  EXPECT_TRUE(offscreen(1).pick({.pixel = {80, 60}, .reach_px = 20}));
  EXPECT_FALSE(offscreen(1).pick({.pixel = {0, 0}}));
  EXPECT_FALSE(offscreen(1).pick({.pixel = {160, 3}}));
  EXPECT_THROW((void)offscreen(1).pick({.view = 1, .pixel = {80, 60}}), std::invalid_argument);
}

TEST_P(PickedPixels, OfPairsThatAreLeftOutAreWhatLiesBehind) {
  Crowd crowd(6);
  const View view = overSmallFloor();
  (void)draw(view, crowd.scene, options());
  int changed = 0;
  for (int v = 10; v < 110; v += 10) {
    for (int u = 10; u < 150; u += 10) {
      (void)draw(view, crowd.scene, options());
      const auto first = offscreen(1).pick({.pixel = {u, v}});
      if (!first || first->kind != Picked::Kind::pair) continue;
      PairGlyphs glyphs = *crowd.scene.pairs;
      glyphs.choice.left_out = {{first->j, first->i}};
      Scene without = crowd.scene;
      without.pairs = std::make_shared<PairGlyphs>(glyphs);
      (void)draw(view, without, options());
      EXPECT_FALSE(same(first, offscreen(1).pick({.pixel = {u, v}}))) << u << ' ' << v;
      ++changed;
    }
  }
  EXPECT_GT(changed, 10);
}

class Pick : public PairTest {};

TEST_F(Pick, TakesTheNearestWithinReach) {
  const View view = overSmallFloor(0.0);
  Scene scene;
  scene.ellipsoids = {{{0, 0, 0}, 0.05 * Eigen::Matrix3d::Identity(), kWhite, 5}};
  scene.lines = {{.points = {{-1, 0.4, 0}, {1, 0.4, 0}}, .width_px = 3.0, .tag = 6}};
  scene.arrows = {{.origin = {-0.5, -0.3, 0}, .heading = 0.0, .tag = 7}};
  (void)draw(view, scene, {});
  const auto pixelOf = [&view](const Eigen::Vector3d& p) -> Eigen::Vector2i {
    return project(view.camera, view.T_eye_scene * p).array().round().cast<int>();
  };
  const Eigen::Vector2i middle = pixelOf({0, 0, 0});
  const Eigen::Vector2i beside = pixelOf({0.09, 0, 0});
  const auto tagAt = [&](const Eigen::Vector2i& pixel, int reach) -> std::uint64_t {
    const auto picked = offscreen(1).pick({.pixel = pixel, .reach_px = reach});
    return picked ? picked->tag : 0;
  };
  EXPECT_EQ(tagAt(middle, 0), 5U);
  EXPECT_EQ(tagAt(beside, 0), 0U);
  EXPECT_EQ(tagAt(beside, 4), 5U);
  EXPECT_EQ(tagAt(pixelOf({0.2, 0.4, 0}), 0), 6U);
  EXPECT_EQ(tagAt(pixelOf({-0.4, -0.3, 0}), 0), 7U);
}

TEST_F(Pick, HasNothingBeforeAnythingWasDrawn) {
  Offscreen fresh(gpu_, 32, 32);
  EXPECT_FALSE(fresh.pick({}));
}

}  // namespace
}  // namespace slamscope::engine
