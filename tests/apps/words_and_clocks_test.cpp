// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "apps/lib/nearest_word.hpp"
#include "apps/lib/view/path_trace.hpp"
#include "apps/lib/view/run_clock.hpp"

namespace slamscope::apps {
namespace {

using namespace std::chrono_literals;

const std::vector<std::string> kVerbs{"demo", "monitor", "simulate", "slam", "info", "convert"};

TEST(NearestWord, FindsATransposition) {
  EXPECT_EQ(nearestWord("slma", kVerbs), "slam");
}

TEST(NearestWord, FindsAMissingLetter) {
  EXPECT_EQ(nearestWord("montor", kVerbs), "monitor");
}

TEST(NearestWord, HasNothingForAnotherWord) {
  EXPECT_EQ(nearestWord("xyzzyplugh", kVerbs), std::nullopt);
}

TEST(RunClock, KeepsTimesOfOneClock) {
  const RunClock clock({.run_start = 1000s, .first_frame = 1002s, .frames_stamped = true});
  EXPECT_TRUE(clock.sameClock());
  EXPECT_EQ(clock.runTime(1005s), 1005s);
}

TEST(RunClock, LaysFramesOfAnotherClockOnTheStart) {
  const RunClock clock({.run_start = 1248444187s, .first_frame = 3s, .frames_stamped = true});
  EXPECT_FALSE(clock.sameClock());
  EXPECT_EQ(clock.runTime(3s), 1248444187s);
  EXPECT_EQ(clock.runTime(5s), 1248444189s);
}

TEST(RunClock, FramesWithoutStampsAreLaidOnTheStart) {
  const RunClock clock({.run_start = 7s, .first_frame = 0s, .frames_stamped = false});
  EXPECT_FALSE(clock.sameClock());
  EXPECT_EQ(clock.runTime(1s), 8s);
}

TEST(RunClock, RateAndOffsetMoveTheRunNotTheFrame) {
  const RunClock clock(
      {.run_start = 10s, .first_frame = 0s, .frames_stamped = false, .rate = 4.0, .offset = 500ms});
  EXPECT_EQ(clock.runTime(0s), 12s);
  EXPECT_EQ(clock.runTime(1s), 16s);
}

TEST(PathTrace, KeepsTheNewestPositionHoweverClose) {
  PathTrace trace;
  trace.add({0.0, 0.0});
  trace.add({1.0, 0.0});
  trace.add({1.0, 1e-6});
  ASSERT_EQ(trace.points().size(), 3U);
  EXPECT_EQ(trace.points().back(), Eigen::Vector2d(1.0, 1e-6));
}

TEST(PathTrace, StaysBoundedOverALongRunAndKeepsItsEnds) {
  PathTrace trace;
  for (int k = 0; k <= 100000; ++k) trace.add({0.003 * k, 0.0});
  const auto points = trace.points();
  EXPECT_LE(points.size(), PathTrace::kMostPoints + 1);
  EXPECT_GE(points.size(), PathTrace::kMostPoints / 4);
  EXPECT_EQ(points.front().x(), 0.0);
  EXPECT_DOUBLE_EQ(points.back().x(), 300.0);
}

}  // namespace
}  // namespace slamscope::apps
