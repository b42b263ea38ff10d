// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "engine/render/offscreen.hpp"
#include "tests/bench/ellipsoid_floor.hpp"
#include "tests/bench/pair_map.hpp"

namespace slamscope::engine {
namespace {

std::shared_ptr<const Image> picture() {
  auto image = std::make_shared<Image>(Image{kBenchCamera.width, kBenchCamera.height, {}});
  for (int i = 0; i < kBenchCamera.width * kBenchCamera.height; ++i) {
    const auto grey = static_cast<std::uint8_t>(100 + i % 97);
    image->rgba.insert(image->rgba.end(), {grey, grey, grey, 255});
  }
  return image;
}

/// A lens with some barrel distortion.
std::shared_ptr<const LookupMap> lens() {
  auto map = std::make_shared<LookupMap>(LookupMap{kBenchCamera.width, kBenchCamera.height, {}});
  for (int v = 0; v < kBenchCamera.height; ++v) {
    for (int u = 0; u < kBenchCamera.width; ++u) {
      const double x = (u - kBenchCamera.cx) / kBenchCamera.fx;
      const double y = (v - kBenchCamera.cy) / kBenchCamera.fy;
      const double bend = 1.0 - 0.1 * (x * x + y * y);
      map->uv_px.push_back(static_cast<float>(kBenchCamera.cx + bend * x * kBenchCamera.fx));
      map->uv_px.push_back(static_cast<float>(kBenchCamera.cy + bend * y * kBenchCamera.fy));
    }
  }
  return map;
}

/// Every glyph is uploaded anew and the picture read back each frame. background: 0 none, 1 pixel
/// by pixel, 2 through a lens.
void drawFrame(benchmark::State& state) {
  const auto views = static_cast<std::size_t>(state.range(2));
  std::vector<View> eyes = aboveFloor(views);
  for (View& eye : eyes) {
    if (state.range(1) > 0) eye.background.image = picture();
    if (state.range(1) > 1) eye.background.map = lens();
  }
  const Scene scene = ellipsoidFloor(static_cast<int>(state.range(0)));
  const auto gpu = std::make_shared<Gpu>();
  Offscreen offscreen(gpu, kBenchCamera.width, kBenchCamera.height, static_cast<int>(views));
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

/// All pairs of n features. changing: another covariance each frame, sent to the device.
void drawPairs(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const auto views = static_cast<std::size_t>(state.range(1));
  const bool changing = state.range(2) != 0;
  const std::vector<View> eyes = aboveFloor(views);
  std::vector<Scene> scenes;
  for (unsigned seed = 1; seed <= 2; ++seed) {
    scenes.emplace_back().pairs = std::make_shared<PairGlyphs>(mapOf(n, seed));
  }
  Offscreen offscreen(std::make_shared<Gpu>(), kBenchCamera.width, kBenchCamera.height,
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
