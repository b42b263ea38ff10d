// SPDX-License-Identifier: MIT
// One EKF-SLAM step, predict + update with ten range-bearing observations, at n features. In the
// same run, wall time: the textbook's filter (`textbook_ratio`: how many times longer it takes),
// and what the machine can do at best (`times_limit`: how many times longer ours takes than that).
// Beside MRPT's: slamscope_peers.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "slam/ekf_slam.hpp"
#include "tests/bench/ekf_drive.hpp"
#include "tests/bench/machine_limit.hpp"
#include "tests/bench/textbook_ekf.hpp"
#include "tests/bench/timing.hpp"

namespace slamscope::slam::bench {
namespace {

double secondsPerStep(const std::function<void(std::size_t)>& step, int count) {
  step(0);
  return wallSeconds([&] {
           for (int k = 0; k < count; ++k) step(static_cast<std::size_t>(k % kSteps));
         }) /
         count;
}

void ekfStep(benchmark::State& state) {
  const int features = static_cast<int>(state.range(0));
  const Drive drive(features);
  EkfOptions options;
  options.update = state.range(1) == 0 ? UpdateMode::batch : UpdateMode::sequential;
  EkfSlam filter(options);
  filter.observe(std::chrono::nanoseconds(0), drive.first);
  Textbook textbook(drive.first);
  std::chrono::nanoseconds time{0};
  const auto ours = [&](std::size_t k) { filter.step(++time, drive.motion, drive.readings[k]); };
  const auto theirs = [&](std::size_t k) { textbook.step(drive.motion, drive.readings[k]); };
  std::size_t k = 0;
  for (auto _ : state) {
    ours(k);
    k = (k + 1) % kSteps;
  }
  const int count = features < 50 ? 20 * kSteps : features < 500 ? kSteps : 8;
  const double seconds = secondsPerStep(ours, std::max(count, kSteps));
  state.counters["textbook_ratio"] = secondsPerStep(theirs, count) / seconds;
  state.counters["times_limit"] = seconds / machineLimit(features);
}

BENCHMARK(ekfStep)
    ->ArgNames({"n", "sequential"})
    ->ArgsProduct({{15, 100, 300, 1000}, {0, 1}})
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace slamscope::slam::bench
