// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <cmath>

#include "tracking/lab.hpp"

namespace slamscope::tracking {
namespace {

/// 1280 × 720 with fifteen posts, the robot on a circle.
LabOptions busyLab() {
  LabOptions options = defaultLab();
  options.rest_frames = 0;
  for (int i = 0; i < 15; ++i)
    options.posts.push_back(
        {static_cast<std::uint64_t>(i), {1.3 * std::cos(0.42 * i), 1.2 * std::sin(0.42 * i)}});
  options.robot_pose_map = [](std::chrono::nanoseconds time) {
    const double s = 0.6 * std::chrono::duration<double>(time).count();
    return Eigen::Vector3d(0.5 * std::cos(s), 0.5 * std::sin(s), s + M_PI / 2);
  };
  return options;
}

void labEmptyRoom(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(Lab(busyLab()).count());
}
BENCHMARK(labEmptyRoom)->Unit(benchmark::kMillisecond);

void labFrame(benchmark::State& state) {
  LabOptions options = busyLab();
  options.rest_frames = state.range(0) != 0 ? 0 : 1000000;
  Lab lab(options);
  for (auto _ : state) benchmark::DoNotOptimize(lab.next());
}
BENCHMARK(labFrame)->ArgName("moving")->Arg(0)->Arg(1)->MeasureProcessCPUTime()->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace slamscope::tracking
