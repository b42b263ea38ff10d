// SPDX-License-Identifier: MIT
#include "apps/lib/view/key_commands.hpp"

#include <gtest/gtest.h>

#include "apps/lib/view/monitor.hpp"
#include "apps/lib/view/scene_builder.hpp"

namespace slamscope::apps {
namespace {

TEST(KeyCommands, ModeGoesRoundTheThreeOfThePaperAndTheAlarms) {
  Monitor::Choices choices;
  KeyCommands keys(choices);
  keys.press('m');
  EXPECT_EQ(choices.mode, slam::PairMode::between_clusters);
  keys.press('m');
  EXPECT_EQ(choices.mode, slam::PairMode::min_mean_max);
  keys.press('m');
  EXPECT_EQ(choices.mode, slam::PairMode::alarms);
  keys.press('m');
  EXPECT_EQ(choices.mode, slam::PairMode::all);
}

TEST(KeyCommands, ColoursAreThePapersOrTheSafeOnes) {
  Monitor::Choices choices;
  KeyCommands keys(choices);
  keys.press('c');
  EXPECT_EQ(choices.palette, PaletteName::safe);
  keys.press('c');
  EXPECT_EQ(choices.palette, PaletteName::paper);
}

TEST(KeyCommands, AxisBringsItsOwnGain) {
  Monitor::Choices choices;
  KeyCommands keys(choices);
  keys.press('a');
  EXPECT_EQ(choices.axis.axis, slam::Axis::eigenvalue);
  EXPECT_EQ(choices.axis.gain, defaultGain(slam::Axis::eigenvalue));
  keys.press('a');
  EXPECT_EQ(choices.axis.axis, slam::Axis::log);
  EXPECT_EQ(choices.axis.gain, 1.0);
}

TEST(KeyCommands, FadeTakesEverythingAwayAndBack) {
  Monitor::Choices choices;
  KeyCommands keys(choices);
  keys.press('f');
  EXPECT_LT(choices.opacity, 1.0);
  keys.press('f');
  EXPECT_EQ(choices.opacity, 0.0);
  keys.press('f');
  EXPECT_EQ(choices.opacity, 1.0);
}

TEST(KeyCommands, OneFrameIsTakenOnceAndPauses) {
  Monitor::Choices choices;
  KeyCommands keys(choices);
  keys.press('.');
  EXPECT_TRUE(keys.paused());
  EXPECT_TRUE(keys.takeStep());
  EXPECT_FALSE(keys.takeStep());
}

TEST(KeyCommands, QuitAndUnknown) {
  Monitor::Choices choices;
  KeyCommands keys(choices);
  keys.press('z');
  EXPECT_FALSE(keys.quit());
  keys.press('q');
  EXPECT_TRUE(keys.quit());
}

}  // namespace
}  // namespace slamscope::apps
