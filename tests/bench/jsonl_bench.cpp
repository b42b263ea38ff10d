// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "slam/jsonl.hpp"

namespace slamscope::slam {
namespace {

/// A record with numbers of full length, as a filter writes them.
Snapshot someSnapshot(int features) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Snapshot snapshot;
  snapshot.time = std::chrono::nanoseconds(1248444187156000000);
  snapshot.pose = {normal(random), normal(random), normal(random)};
  for (int k = 0; k < features; ++k) {
    snapshot.ids.push_back(static_cast<FeatureId>(k));
    snapshot.features.emplace_back(normal(random), normal(random));
  }
  snapshot.covariance = PackedCovariance(3 + 2 * features);
  for (int row = 0; row < snapshot.covariance.size(); ++row) {
    for (int col = 0; col <= row; ++col) snapshot.covariance(row, col) = 1e-3 * normal(random);
  }
  return snapshot;
}

void countText(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

void readJsonLine(benchmark::State& state) {
  const std::string line = formatRecord(someSnapshot(static_cast<int>(state.range(0))));
  LineParser parser;
  for (auto _ : state) benchmark::DoNotOptimize(parser.record(line, 0));
  countText(state, line.size());
}
BENCHMARK(readJsonLine)->Arg(15)->Arg(100)->ArgName("features");

void writeJsonLine(benchmark::State& state) {
  const Snapshot snapshot = someSnapshot(static_cast<int>(state.range(0)));
  std::string line;
  for (auto _ : state) {
    line.clear();
    appendRecord(line, snapshot);
    benchmark::DoNotOptimize(line.data());
  }
  countText(state, line.size());
}
BENCHMARK(writeJsonLine)->Arg(15)->Arg(100)->ArgName("features");

}  // namespace
}  // namespace slamscope::slam
