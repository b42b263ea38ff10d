// SPDX-License-Identifier: MIT
#include "apps/lib/whole_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace slamscope::apps {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class WholeFile : public testing::Test {
 protected:
  WholeFile() { fs::create_directories(folder_); }
  ~WholeFile() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("slamscope-whole-file-" + std::to_string(getpid()));
};

TEST_F(WholeFile, TakesThePlaceOfTheOneBefore) {
  writeWhole(folder_ / "report.json", "first, and longer\n");
  writeWhole(folder_ / "report.json", "second\n");
  EXPECT_EQ(textOf(folder_ / "report.json"), "second\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "something is left beside it";
}

TEST_F(WholeFile, KeepsTheOneBeforeWhereItCantBeWritten) {
  writeWhole(folder_ / "report.json", "first\n");
  fs::create_directory(folder_ / "report.json.partial");  // in the way
  EXPECT_THROW(writeWhole(folder_ / "report.json", "second\n"), std::runtime_error);
  EXPECT_EQ(textOf(folder_ / "report.json"), "first\n");
  EXPECT_THROW(writeWhole(folder_ / "none" / "report.json", "text"), std::runtime_error);
}

TEST_F(WholeFile, WritesStraightIntoADevice) {
  writeWhole("/dev/null", "text");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THROW(writeWhole("/dev/full", "text"), std::runtime_error);
}

}  // namespace
}  // namespace slamscope::apps
