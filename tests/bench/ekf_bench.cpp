// SPDX-License-Identifier: MIT
// One EKF-SLAM step, predict + update with ten range-bearing observations, at n features; beside it
// the textbook's filter in the same run: `textbook_ratio` is how many times longer that one takes.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <numbers>
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

template <typename Step>
double secondsPerStep(Step step, int count) {
  const std::clock_t start = std::clock();  // processor time: machines are shared
  for (int k = 0; k < count; ++k) step(static_cast<std::size_t>(k % kSteps));
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / count;
}

void ekfStep(benchmark::State& state) {
  const Drive drive(static_cast<int>(state.range(0)));
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
  const int count = state.range(0) < 50 ? 5 * kSteps : kSteps;
  state.counters["textbook_ratio"] = secondsPerStep(theirs, count) / secondsPerStep(ours, count);
}

BENCHMARK(ekfStep)
    ->ArgNames({"n", "sequential"})
    ->ArgsProduct({{15, 100, 300}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace slamscope::slam
