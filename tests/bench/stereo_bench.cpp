// SPDX-License-Identifier: MIT
// A frame of an HMD from two camera pictures to one picture of both eyes.
#include <benchmark/benchmark.h>

#include "apps/lib/view/stereo_picture.hpp"
#include "tests/bench/ellipsoid_floor.hpp"

namespace slamscope::apps {
namespace {

/// Two cameras with lenses of that size, before a display with lenses where `lensed`.
tracking::Rig rigOf(int width, int height, bool lensed) {
  tracking::Rig rig = tracking::guessedRig(width, height, 2);
  for (tracking::RigCamera& camera : rig.cameras) {
    camera.info.D = {-0.11, 0.03, 0.0005, -0.0003, -0.004};
    if (lensed) camera.display = {.k = {0.22, 0.24, 0.0}, .zoom = 1.1};
  }
  return rig;
}

tracking::Frame frameOf(int width, int height) {
  tracking::Frame frame{.source = {}, .width = width, .height = height, .bgr = {}};
  for (int i = 0; i < width * height * 3; ++i) {
    frame.bgr.push_back(static_cast<std::uint8_t>(100 + i % 97));
  }
  return frame;
}

/// Undistortion, upload, every ellipsoid anew, both eyes, read-back, lenses, layout.
void stereoFrame(benchmark::State& state) {
  const auto width = static_cast<int>(state.range(0));
  const int height = width == 800 ? 600 : 720;
  const auto gpu = std::make_shared<engine::Gpu>();
  StereoPicture picture(gpu, rigOf(width, height, state.range(2) != 0), {});
  const tracking::StereoFrame frames{{frameOf(width, height), frameOf(width, height)}};
  const engine::Scene scene = engine::ellipsoidFloor(static_cast<int>(state.range(1)));
  for (engine::View& view : picture.views()) {
    view.T_eye_scene = engine::overFloor(view.camera).T_eye_scene;
  }
  picture.views()[1].T_eye_scene.pretranslate(Eigen::Vector3d(-0.064, 0.0, 0.0));
  double gpu_ms = 0.0;
  for (auto _ : state) {
    picture.takeFrames(frames);
    benchmark::DoNotOptimize(picture.draw(scene, {}).rgba.data());
    gpu_ms += picture.lastStats().gpu_ms;
  }
  state.counters["gpu_ms"] = benchmark::Counter(gpu_ms, benchmark::Counter::kAvgIterations);
  state.SetLabel(gpu->device().name);
}
BENCHMARK(stereoFrame)
    ->ArgNames({"width", "ellipsoids", "lens"})
    ->ArgsProduct({{800, 1280}, {0, 105, 435}, {0, 1}})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slamscope::apps
