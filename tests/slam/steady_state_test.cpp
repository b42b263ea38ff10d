// SPDX-License-Identifier: MIT
// A filter whose map has grown up needs no more memory: counted at malloc itself, because Eigen
// goes past operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "slam/ekf_slam.hpp"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {
std::atomic<bool> counting{false};
std::atomic<int> allocations{0};
}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);

void* malloc(std::size_t size) {
  if (counting) ++allocations;
  return __libc_malloc(size);
}
}

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

/// Allocations of 50 steps, after 50 others, with up to ten readings a step.
int allocationsOf(EkfSlam& filter, int features) {
  const Eigen::Matrix2d R = Eigen::Vector2d(0.0036, 0.0016).asDiagonal();
  const Motion motion =
      Motion::fromIncrement({0.01, 0.0, 0.01}, 1e-5 * Eigen::Matrix3d::Identity());
  std::vector<Observation> all;
  for (int k = 1; k <= features; ++k) {
    all.push_back({static_cast<FeatureId>(k), {2.0 + 0.01 * k, 0.3 * std::sin(k)}, R});
  }
  filter.observe(0ns, all);
  std::vector<std::vector<Observation>> readings(100);
  for (std::size_t step = 0; step < readings.size(); ++step) {
    for (std::size_t k = 0; k < 1 + step % 10; ++k) {
      readings[step].push_back(all[(step * 7 + k) % all.size()]);
    }
  }
  for (std::size_t step = 0; step < readings.size(); ++step) {
    if (step == 50) {
      allocations = 0;
      counting = true;
    }
    filter.step(std::chrono::milliseconds(step + 1), motion, readings[step]);
  }
  counting = false;
  return allocations;
}

TEST(SteadyState, AllocatesNothing) {
  for (const UpdateMode mode : {UpdateMode::batch, UpdateMode::sequential}) {
    for (const int features : {15, 300}) {
      EkfOptions options;
      options.update = mode;
      options.gate_probability = 0.9999999;
      EkfSlam filter(options);
      EXPECT_EQ(allocationsOf(filter, features), 0) << features;
    }
  }
}

TEST(SteadyState, SomebodyWhoListensCosts) {
  EkfSlam filter{EkfOptions{}};
  const auto subscription = filter.observe({Event::step}, [](const SnapshotPtr&) {});
  EXPECT_GE(allocationsOf(filter, 15), 50) << "must be seen";
}

}  // namespace
}  // namespace slamscope::slam

#endif
