// SPDX-License-Identifier: MIT
// One EKF-SLAM step, predict + update with ten range-bearing observations, at n features. In the
// same run, wall time: the textbook's filter (`textbook_ratio`: how many times longer it takes),
// and what the machine can do at best (`times_limit`: how many times longer ours takes than that).
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <thread>
#include <vector>

#include "slam/angle.hpp"
#include "slam/ekf_slam.hpp"
#include "slam/simulation_random.hpp"

namespace slamscope::slam {
namespace {

constexpr int kObservations = 10;
constexpr int kSteps = 64;  // of a circle, driven again and again

const Eigen::Matrix2d kM = Eigen::Vector2d(0.0009, 0.0036).asDiagonal();
const Eigen::Matrix2d kR = Eigen::Vector2d(0.0036, 0.0016).asDiagonal();

/// A circle among features on a wider ring, with the readings of each step.
struct Drive {
  std::vector<Observation> first;  ///< one reading of every feature, from the start
  Motion motion;
  std::vector<std::vector<Observation>> readings;

  explicit Drive(int count) {
    RandomSource random(1);
    std::vector<Eigen::Vector2d> features;
    for (int k = 0; k < count; ++k) {
      const double angle = random.uniform(-3.1, 3.1);
      const double radius = random.uniform(2.0, 5.0);
      features.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    const auto read = [&](const Eigen::Vector3d& pose, std::size_t k) {
      Eigen::Vector2d z = observeFeature(Sensor::range_bearing, pose, features[k]);
      z += Eigen::Vector2d(0.06 * random.normal(), 0.04 * random.normal());
      return Observation{k, z, kR};
    };
    Eigen::Vector3d pose = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < features.size(); ++k) first.push_back(read(pose, k));
    const double turn = 2.0 * std::numbers::pi / (kSteps * 0.1);
    motion = Motion::fromVelocity(0.25, turn, 0.1, kM);
    for (int step = 0; step < kSteps; ++step) {
      pose = movePose(pose, motion.increment);
      std::vector<Observation>& now = readings.emplace_back();
      for (int k = 0; k < kObservations; ++k) {
        now.push_back(read(pose, static_cast<std::size_t>((step * 7 + k) % count)));
      }
    }
  }
};

/// As textbooks print it: one observation after the other, dense H, the whole of P.
class Textbook {
 public:
  explicit Textbook(const std::vector<Observation>& first) {
    const auto size = static_cast<Eigen::Index>(3 + 2 * first.size());
    x_ = Eigen::VectorXd::Zero(size);
    P_ = Eigen::MatrixXd::Identity(size, size) * 0.01;
    for (const Observation& o : first) {
      x_.segment<2>(row(o)) = locateFeature(Sensor::range_bearing, x_.head<3>(), o.z);
    }
  }

  void step(const Motion& motion, const std::vector<Observation>& readings) {
    Eigen::Matrix3d F;
    Eigen::Matrix3d G;
    x_.head<3>() = movePose(x_.head<3>(), motion.increment, &F, &G);
    P_.topRows(3) = (F * P_.topRows(3)).eval();
    P_.leftCols(3) = (P_.leftCols(3) * F.transpose()).eval();
    P_.topLeftCorner(3, 3) += G * motion.M * G.transpose();
    for (const Observation& o : readings) update(o);
  }

 private:
  static Eigen::Index row(const Observation& o) { return 3 + 2 * static_cast<Eigen::Index>(o.id); }

  void update(const Observation& o) {
    Matrix23d H_v;
    Eigen::Matrix2d H_f;
    const Eigen::Vector2d z =
        observeFeature(Sensor::range_bearing, x_.head<3>(), x_.segment<2>(row(o)), &H_v, &H_f);
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(2, x_.size());
    H.leftCols(3) = H_v;
    H.middleCols(row(o), 2) = H_f;
    const Eigen::MatrixXd PHt = P_ * H.transpose();
    const Eigen::Matrix2d S = H * PHt + o.R;
    const Eigen::MatrixXd K = PHt * S.inverse();
    x_ += K * observationDifference(Sensor::range_bearing, o.z, z);
    x_[2] = wrapAngle(x_[2]);
    P_ -= K * PHt.transpose();
  }

  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
};

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

double wallSeconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// `work` on `threads` threads at once.
void onThreads(int threads, const std::function<void()>& work) {
  std::vector<std::jthread> crew;
  for (int t = 1; t < threads; ++t) crew.emplace_back(work);
  work();
}

/// Seconds that the covariance update needs at least: N² m flops on the lower half, or that half
/// read and written once, whichever takes longer, on one thread or two.
double machineLimit(int count) {
  const double size = 3.0 + 2.0 * count;
  const double flops = size * size * 2.0 * kObservations;
  constexpr long kRounds = 20'000'000;
  std::vector<double> half(static_cast<std::size_t>(size * size / 2.0));
  const auto pass = [](double* begin, double* end) {
    for (double* value = begin; value != end; ++value) *value = *value * 0.5 + 1.0;
    benchmark::ClobberMemory();
  };
  const int repeats = std::max(1, static_cast<int>(2e8 / static_cast<double>(half.size())));
  double best = 1e9;
  for (const int threads : {1, 2}) {
    double compute = 1e9;
    double memory = 1e9;
    for (int attempt = 0; attempt < 3; ++attempt) {
      const double multiplied = wallSeconds(
          [&] { onThreads(threads, [] { benchmark::DoNotOptimize(multiplyAdd(kRounds)); }); });
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
}  // namespace slamscope::slam
