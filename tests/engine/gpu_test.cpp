// SPDX-License-Identifier: MIT
#include "engine/gpu/gpu.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "engine/gpu/device_info.hpp"

namespace slamscope::engine {
namespace {

/// Sets an environment variable for as long as it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Environment() { unsetenv(name_); }

 private:
  const char* name_;
};

std::string refusal(const GpuOptions& options) {
  try {
    const Gpu gpu(options);
  } catch (const NoVulkanDevice& error) {
    return error.what();
  }
  return "";
}

TEST(Devices, AreListedWithIndexNameTypeVersionAndDriver) {
  const auto devices = listDevices();
  ASSERT_FALSE(devices.empty());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, static_cast<int>(i));
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].type.empty());
    EXPECT_FALSE(devices[i].driver.empty());
    EXPECT_EQ(devices[i].api_version.substr(0, 2), "1.");
  }
}

TEST(Devices, AreChosenByIndexAndByPartOfNameInAnyCase) {
  const Gpu first;
  EXPECT_TRUE(first.device().lacks.empty());
  const Gpu by_index({.device = std::to_string(first.device().index)});
  EXPECT_EQ(by_index.device().name, first.device().name);
  std::string part = first.device().name.substr(0, 4);
  for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(Gpu({.device = part}).device().name.substr(0, 4), first.device().name.substr(0, 4));
}

TEST(Devices, AnUnknownOneIsRefusedWithTheListOfThoseThatAre) {
  const std::string by_name = refusal({.device = "no such card"});
  EXPECT_NE(by_name.find("'no such card'"), std::string::npos) << by_name;
  EXPECT_NE(by_name.find(listDevices().front().name), std::string::npos) << by_name;
  EXPECT_NE(refusal({.device = "99"}).find("'99'"), std::string::npos);
  EXPECT_EQ(refusal({}), "");
}

TEST(Devices, WithoutADriverTheMessageSaysWhatToInstall) {
  const Environment none("VK_ICD_FILENAMES", "/nonexistent.json");
  const Environment none_new("VK_DRIVER_FILES", "/nonexistent.json");
  const std::string message = refusal({});
  EXPECT_NE(message.find("no Vulkan device"), std::string::npos) << message;
  EXPECT_NE(message.find("mesa-vulkan-drivers"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_THROW((void)listDevices(), NoVulkanDevice);
}

}  // namespace
}  // namespace slamscope::engine
