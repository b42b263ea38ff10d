// SPDX-License-Identifier: MIT
#include "tests/bench/machine_limit.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

#include "tests/bench/ekf_drive.hpp"
#include "tests/bench/timing.hpp"

namespace slamscope::slam::bench {
namespace {

using Vector4 [[gnu::vector_size(32)]] = double;

/// Nothing but fused multiply-adds on registers: GFLOP/s of one thread.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
[[gnu::target_clones("fma", "default")]]
#endif
double
multiplyAdd(long rounds) {
  Vector4 sums[12];
  for (int k = 0; k < 12; ++k) sums[k] = Vector4{1.0 + k, 2.0, 3.0, 4.0};
  const Vector4 factor{1.0 - 1e-9, 1.0 - 2e-9, 1.0 - 3e-9, 1.0 - 4e-9};
  for (long round = 0; round < rounds; ++round) {
#pragma GCC unroll 12
    for (int k = 0; k < 12; ++k) sums[k] = sums[k] * factor + factor;
  }
  Vector4 total{};
  for (const Vector4& sum : sums) total += sum;
  return total[0] + total[1] + total[2] + total[3];
}

/// `work` on `threads` threads at once.
void onThreads(int threads, const std::function<void()>& work) {
  std::vector<std::jthread> crew;
  for (int t = 1; t < threads; ++t) crew.emplace_back(work);
  work();
}

}  // namespace

double machineLimit(int count) {
  const double size = 3.0 + 2.0 * count;
  const double flops = size * size * 2.0 * kObservations;
  constexpr long kRounds = 20'000'000;
  std::vector<double> half(static_cast<std::size_t>(size * size / 2.0));
  const auto pass = [](double* begin, double* end) {
    for (double* value = begin; value != end; ++value) *value = *value * 0.5 + 1.0;
    asm volatile("" : : : "memory");  // every pass is seen
  };
  const int repeats = std::max(1, static_cast<int>(2e8 / static_cast<double>(half.size())));
  double best = 1e9;
  for (const int threads : {1, 2}) {
    double compute = 1e9;
    double memory = 1e9;
    for (int attempt = 0; attempt < 3; ++attempt) {
      const double multiplied = wallSeconds([&] {
        onThreads(threads, [] {
          const double kept = multiplyAdd(kRounds);
          asm volatile("" : : "g"(kept) : "memory");
        });
      });
      compute = std::min(compute, flops * multiplied / (kRounds * 12.0 * 8.0 * threads));
      std::atomic<int> next{0};
      const std::size_t share = half.size() / static_cast<std::size_t>(threads);
      const double passed = wallSeconds([&] {
        onThreads(threads, [&] {
          double* const begin = half.data() + share * static_cast<std::size_t>(next++);
          for (int k = 0; k < repeats; ++k) pass(begin, begin + share);
        });
      });
      memory = std::min(memory, passed / repeats);
    }
    best = std::min(best, std::max(compute, memory));
  }
  return best;
}

}  // namespace slamscope::slam::bench
