// SPDX-License-Identifier: MIT
#include "engine/window/displays.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace slamscope::engine {
namespace {

const std::vector<Display> kTwo = {{.index = 0, .name = "eDP-1"}, {.index = 1, .name = "HDMI-1"}};

TEST(Displays, AreFoundByIndexNameOrAPartOfOneName) {
  EXPECT_EQ(findDisplay(kTwo, "1").name, "HDMI-1");
  EXPECT_EQ(findDisplay(kTwo, "eDP-1").index, 0);
  EXPECT_EQ(findDisplay(kTwo, "HDMI").index, 1);
}

TEST(Displays, ThoseThatAreNotThereAreAnsweredWithWhatThereIs) {
  EXPECT_THROW((void)findDisplay(kTwo, "-1"), std::runtime_error) << "part of two names";
  try {
    (void)findDisplay(kTwo, "Trivisio");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "display Trivisio: there is 0 eDP-1, 1 HDMI-1");
  }
}

}  // namespace
}  // namespace slamscope::engine
