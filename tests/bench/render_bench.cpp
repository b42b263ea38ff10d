// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "engine/render/offscreen.hpp"
#include "engine/scene/pair_glyphs.hpp"
#include "tests/bench/ellipsoid_floor.hpp"

namespace slamscope::engine {
namespace {

constexpr Pinhole kCamera = {
    .width = 1280, .height = 720, .fx = 900.0, .fy = 900.0, .cx = 639.5, .cy = 359.5};

std::shared_ptr<const Image> picture() {
  auto image = std::make_shared<Image>(Image{kCamera.width, kCamera.height, {}});
  for (int i = 0; i < kCamera.width * kCamera.height; ++i) {
    const auto grey = static_cast<std::uint8_t>(100 + i % 97);
    image->rgba.insert(image->rgba.end(), {grey, grey, grey, 255});
  }
  return image;
}

/// A lens with some barrel distortion.
std::shared_ptr<const LookupMap> lens() {
  auto map = std::make_shared<LookupMap>(LookupMap{kCamera.width, kCamera.height, {}});
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const double x = (u - kCamera.cx) / kCamera.fx;
      const double y = (v - kCamera.cy) / kCamera.fy;
      const double bend = 1.0 - 0.1 * (x * x + y * y);
      map->uv_px.push_back(static_cast<float>(kCamera.cx + bend * x * kCamera.fx));
      map->uv_px.push_back(static_cast<float>(kCamera.cy + bend * y * kCamera.fy));
    }
  }
  return map;
}

/// Every glyph is uploaded anew and the picture read back each frame. background: 0 none, 1 pixel
/// by pixel, 2 through a lens.
void drawFrame(benchmark::State& state) {
  const auto views = static_cast<std::size_t>(state.range(2));
  View view = overFloor(kCamera);
  if (state.range(1) > 0) view.background.image = picture();
  if (state.range(1) > 1) view.background.map = lens();
  std::vector<View> eyes(views, view);
  if (views > 1) eyes[1].T_eye_scene.pretranslate(Eigen::Vector3d(-0.064, 0.0, 0.0));
  const Scene scene = ellipsoidFloor(static_cast<int>(state.range(0)));
  const auto gpu = std::make_shared<Gpu>();
  Offscreen offscreen(gpu, kCamera.width, kCamera.height, static_cast<int>(views));
  std::vector<Image> pictures;
  double gpu_ms = 0.0;
  for (auto _ : state) {
    offscreen.draw(eyes, scene, {}, pictures);
    gpu_ms += offscreen.lastStats().gpu_ms;
    benchmark::DoNotOptimize(pictures.front().rgba.data());
  }
  state.counters["gpu_ms"] = benchmark::Counter(gpu_ms, benchmark::Counter::kAvgIterations);
  state.SetLabel(gpu->device().name);
}
BENCHMARK(drawFrame)
    ->ArgNames({"ellipsoids", "background", "views"})
    ->ArgsProduct({{0, 105, 435}, {0, 1, 2}, {1}})
    ->Args({105, 2, 2})
    ->Args({435, 2, 2})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

/// A map of n features all over the floor that is seen, in no order. Larger maps are seen from
/// farther away: the 3-sigma semi-axes of pairs are some 16 px long for 15 features and 2 px for
/// 1000.
PlanarPointsPtr mapOf(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> means;
  for (int i = 0; i < n; ++i) means.emplace_back(place(random), place(random));
  const double sigma =
      0.056 / std::sqrt(n);  // m, of a feature in what it has in common with others
  Eigen::MatrixXd root(2 * n, 6);
  for (int k = 0; k < root.size(); ++k) root(k) = sigma * normal(random) / std::sqrt(6.0);
  std::vector<double> packed;
  for (int row = 0; row < 2 * n; ++row) {
    for (int column = 0; column < row; ++column) {
      packed.push_back(root.row(row).dot(root.row(column)));
    }
    packed.push_back(root.row(row).squaredNorm() + 0.04 * sigma * sigma);
  }
  return std::make_shared<PlanarPoints>(means, packed);
}

/// All pairs of n features. changing: another covariance each frame, sent to the device.
void drawPairs(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const auto views = static_cast<std::size_t>(state.range(1));
  const bool changing = state.range(2) != 0;
  std::vector<View> eyes(views, overFloor(kCamera));
  if (views > 1) eyes[1].T_eye_scene.pretranslate(Eigen::Vector3d(-0.064, 0.0, 0.0));
  std::vector<Scene> scenes;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    scenes.emplace_back().pairs =
        std::make_shared<PairGlyphs>(PairGlyphs{.points = mapOf(n, seed),
                                                .axis = {.gain = 3.0},
                                                .choice = {},
                                                .colour = {0.9F, 0.1F, 0.1F, 1.0F}});
  }
  Offscreen offscreen(std::make_shared<Gpu>(), kCamera.width, kCamera.height,
                      static_cast<int>(views));
  const RenderOptions options{.pair_way = static_cast<PairWay>(state.range(3))};
  std::vector<Image> pictures;
  offscreen.draw(eyes, scenes[0], options, pictures);
  double gpu_ms = 0.0;
  std::size_t frame = 0;
  for (auto _ : state) {
    offscreen.draw(eyes, scenes[changing ? ++frame % 2 : 0], options, pictures);
    gpu_ms += offscreen.lastStats().gpu_ms;
    benchmark::DoNotOptimize(pictures.front().rgba.data());
  }
  state.counters["gpu_ms"] = benchmark::Counter(gpu_ms, benchmark::Counter::kAvgIterations);
  state.counters["drawn"] = static_cast<double>(offscreen.lastStats().pairs.drawn);
  state.SetLabel(offscreen.lastStats().pairs.splatted ? "splats" : "quads");
}
BENCHMARK(drawPairs)
    ->ArgNames({"n", "views", "changing", "way"})
    ->ArgsProduct({{15, 100, 500, 1000}, {1, 2}, {0, 1}, {0}})
    ->ArgsProduct({{15, 100, 500}, {1}, {1}, {1, 2}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slamscope::engine
