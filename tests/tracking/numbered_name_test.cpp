// SPDX-License-Identifier: MIT
#include "tracking/numbered_name.hpp"

#include <gtest/gtest.h>

namespace slamscope::tracking {
namespace {

TEST(NumberedName, IsSplitAtItsFieldAndPutTogetherAgain) {
  const auto name = numberedName("out/frame-%05d.png");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->of(7), "out/frame-00007.png");
  EXPECT_EQ(name->of(123456), "out/frame-123456.png");
  EXPECT_EQ(numberedName("%d")->of(0), "0");
  EXPECT_EQ(numberedName("a%3db")->of(7), "a007b");
}

TEST(NumberedName, FitsItsOwnAlone) {
  const auto name = numberedName("f-%03d.png");
  ASSERT_TRUE(name);
  for (const char* own : {"f-007.png", "f-1234.png"}) EXPECT_TRUE(name->fits(own)) << own;
  for (const char* other :
       {"", "f-.png", "f-07.png", "f-0a7.png", "g-007.png", "f-007.jpg", "f-007.png.png"}) {
    EXPECT_FALSE(name->fits(other)) << other;
  }
}

TEST(NumberedName, TakesNothingElse) {
  for (const char* wrong : {"", "frame.png", "%", "%5", "%s.png", "%-5d.png", "%05x", "%%d.png",
                            "%d-%d.png", "%d-%.png", "%013d.png", "%099999999999999999999d"}) {
    EXPECT_FALSE(numberedName(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace slamscope::tracking
