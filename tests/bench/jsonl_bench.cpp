// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <string>

#include "slam/jsonl.hpp"
#include "slam/run_reader.hpp"
#include "slam/run_writer.hpp"

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

/// A run of 2,000 records as a file: reading, unpacking, cutting lines, checking the order.
void readRunFile(benchmark::State& state, const std::string& ending) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("slamscope_bench" + std::to_string(::getpid()) + ending);
  std::size_t bytes = 0;
  {
    Snapshot snapshot = someSnapshot(15);
    RunWriter writer(path, {});
    for (int k = 0; k < 2000; ++k) {
      snapshot.time += std::chrono::milliseconds(33);
      bytes += formatRecord(snapshot).size() + 1;
      writer.write(snapshot);
    }
    writer.finish();
  }
  for (auto _ : state) {
    RunReader reader(path);
    while (const auto snapshot = reader.next()) benchmark::DoNotOptimize(snapshot);
  }
  countText(state, bytes);
  std::filesystem::remove(path);
}
BENCHMARK_CAPTURE(readRunFile, plain, ".jsonl")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(readRunFile, zst, ".jsonl.zst")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slamscope::slam
