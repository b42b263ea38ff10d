// SPDX-License-Identifier: MIT
#include "slam/line_buffer.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace slamscope::slam {
namespace {

void put(LineBuffer& lines, std::string_view text) {
  const auto room = lines.room(text.size());
  text.copy(room.data(), text.size());
  lines.commit(text.size());
}

std::vector<std::string> drain(LineBuffer& lines) {
  std::vector<std::string> result;
  while (const auto line = lines.next()) result.emplace_back(*line);
  return result;
}

TEST(LineBuffer, CutsLinesHoweverTheBytesArrive) {
  const std::string text = "one\ntwo\r\n\nfour and more";
  for (std::size_t piece = 1; piece <= text.size(); ++piece) {
    LineBuffer lines;
    std::vector<std::string> found;
    for (std::size_t k = 0; k < text.size(); k += piece) {
      put(lines, std::string_view(text).substr(k, piece));
      for (auto& line : drain(lines)) found.push_back(line);
    }
    EXPECT_EQ(found, (std::vector<std::string>{"one", "two", ""})) << piece;
    EXPECT_EQ(lines.rest(), "four and more") << piece;
  }
}

TEST(LineBuffer, RefusesALineBeyondItsBoundAndGoesOnWithTheNext) {
  LineBuffer lines(10);
  put(lines, "short\n0123456789");
  EXPECT_EQ(drain(lines), std::vector<std::string>{"short"});
  put(lines, "0123");
  EXPECT_THROW(drain(lines), std::runtime_error);
  put(lines, "4567");
  EXPECT_TRUE(drain(lines).empty());
  EXPECT_EQ(lines.rest(), "");
  put(lines, "89\nnext\n");
  EXPECT_EQ(drain(lines), std::vector<std::string>{"next"});
}

}  // namespace
}  // namespace slamscope::slam
