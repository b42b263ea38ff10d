// SPDX-License-Identifier: MIT
// What the audit costs beside the filter that it watches, per update. Its records hold the
// innovations too (level L3).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "slam/audit/audit.hpp"
#include "slam/ekf_slam.hpp"
#include "slam/recorder.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

/// A filter with all its features in the map, standing still amid them; each update observes
/// `together` of them, with errors as large as declared.
struct Bench {
  Bench(int features, int at_once) : filter(options()), together(at_once) {
    const Eigen::Matrix2d R = Eigen::Vector2d(0.0036, 0.0016).asDiagonal();
    for (int k = 0; k < features; ++k) {
      const double angle = 0.1 + 2.9 * k / features;
      lawful.push_back({static_cast<FeatureId>(k + 1), {1.0 + 0.001 * k, angle}, R});
    }
    std::vector<Observation> readings = lawful;
    for (Observation& reading : readings) spoil(reading);
    filter.observe(std::chrono::nanoseconds{0}, readings);
  }

  void spoil(Observation& reading) {
    reading.z += Eigen::Vector2d(0.06 * random.normal(), 0.04 * random.normal());
  }

  static EkfOptions options() {
    EkfOptions options;
    options.initial_covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
    return options;
  }

  void update() {
    std::vector<Observation> some;
    for (int k = 0; k < together; ++k) {
      some.push_back(lawful[next++ % lawful.size()]);
      spoil(some.back());
    }
    filter.update(some);
  }

  EkfSlam filter;
  int together;
  std::vector<Observation> lawful;  ///< without errors
  RandomSource random{1};
  std::size_t next = 0;
};

void filterUpdate(benchmark::State& state) {
  Bench bench(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) bench.update();
}

void filterUpdateWithSnapshot(benchmark::State& state) {
  Bench bench(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  SnapshotPtr last;
  const Subscription subscription =
      bench.filter.observe(kRecordAll, [&](const SnapshotPtr& snapshot) { last = snapshot; });
  for (auto _ : state) bench.update();
}

/// The audit alone: takes records of updates that were made before.
void auditUpdate(benchmark::State& state) {
  Bench bench(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  std::vector<SnapshotPtr> records;
  const Subscription subscription = bench.filter.observe(
      kRecordAll, [&](const SnapshotPtr& snapshot) { records.push_back(snapshot); });
  // What the first record of an audit costs more is spread over a run, but no more records than
  // stay in the cache: those of a live filter were written just before.
  const auto bytes = bench.filter.snapshot().covariance.packed().size_bytes();
  const std::size_t most = std::clamp<std::size_t>((std::size_t{1} << 20U) / bytes, 8, 512);
  while (records.size() < most) bench.update();
  RunHeader header;
  header.sensor = Sensor::range_bearing;
  header.R = bench.lawful[0].R;
  std::size_t k = 0;
  Audit audit({}, header);
  for (auto _ : state) {
    if (k == records.size()) {  // begin again: the first record follows none
      state.PauseTiming();
      audit = Audit({}, header);
      audit.take(records[0]);
      k = 1;
      state.ResumeTiming();
    }
    audit.take(records[k++]);
  }
  state.SetLabel(std::string(verdictName(audit.report().verdict)));
}

constexpr auto kSizes = [](benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"features", "observed"})->Unit(benchmark::kMicrosecond);
  for (const int features : {15, 100, 300, 1000}) {
    for (const int observed : {10, 1}) bench->Args({features, observed});
  }
};

BENCHMARK(filterUpdate)->Apply(kSizes);
BENCHMARK(filterUpdateWithSnapshot)->Apply(kSizes);
BENCHMARK(auditUpdate)->Apply(kSizes);

}  // namespace
}  // namespace slamscope::slam
