// SPDX-License-Identifier: MIT
// What a pair of pictures costs before it can be drawn over: tags, then the head.
#include <benchmark/benchmark.h>

#include "tracking/head_tracker.hpp"
#include "tracking/stereo_lab.hpp"
#include "tracking/tag_search.hpp"

namespace slamscope::tracking {
namespace {

constexpr std::uint64_t kPairs = 30;

/// A second of a walk around the robot, 640 × 480.
struct Walk {
  StereoLab lab{defaultStereoLab()};
  std::vector<StereoFrame> pairs;

  Walk() {
    for (std::uint64_t k = 0; k < kPairs; ++k) pairs.push_back(lab.pair(k));
  }
};

const Walk& walk() {
  static const Walk one;
  return one;
}

void searchWholePicture(benchmark::State& state) {
  TagDetector detector({.camera = CameraModel(walk().lab.options().rig.cameras[0].info)});
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(*walk().pairs[0].eyes[0]));
}
BENCHMARK(searchWholePicture)->Unit(benchmark::kMillisecond);

/// One eye's picture after the other, on one thread, the whole picture now and then.
void trackPicture(benchmark::State& state) {
  const Rig& rig = walk().lab.options().rig;
  const TagLayout tags = *walk().lab.tags();
  HeadTracker tracker(rig, tags);
  std::vector<TagSearch> searches;
  for (std::size_t eye = 0; eye < 2; ++eye) searches.emplace_back(EyeCamera(rig, eye), tags);
  std::uint64_t k = 0;
  double used = 0, whole = 0;
  for (auto _ : state) {
    if (k % kPairs == 0) {  // the walk begins anew
      state.PauseTiming();
      tracker = HeadTracker(rig, tags);
      state.ResumeTiming();
    }
    const StereoFrame& pair = walk().pairs[k++ % kPairs];
    std::vector<HeadPicture> pictures;
    for (std::size_t eye = 0; eye < 2; ++eye) {
      std::optional<HeadMotion> motion;
      if (const auto pose = tracker.at(pair.eyes[eye]->time)) motion = pose->motion;
      pictures.push_back({eye, pair.eyes[eye]->time, searches[eye].find(*pair.eyes[eye], motion)});
      whole += searches[eye].whole() ? 0.5 : 0;
    }
    tracker.add(pictures);
    used += tracker.last().tags_used;
  }
  state.counters["tags"] = benchmark::Counter(used, benchmark::Counter::kAvgIterations);
  state.counters["whole"] = benchmark::Counter(whole, benchmark::Counter::kAvgIterations);
}
BENCHMARK(trackPicture)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slamscope::tracking
