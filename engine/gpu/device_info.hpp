// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

// What a person sees of the machine's Vulkan devices; no Vulkan header.
namespace slamscope::engine {

/// One device that Vulkan offers.
struct DeviceInfo {
  int index = 0;            ///< place in listDevices(), what `--device 0` names
  std::string name;         ///< as the driver says it
  std::string type;         ///< "discrete", "integrated", "virtual", "cpu" or "other"
  std::string api_version;  ///< "1.3.230"
  std::string driver;       ///< driver's name and version
  std::string lacks;        ///< what of the engine's needs is missing; empty: usable
};

/// No device to draw with. The text is one line and says what to do: install a loader or a driver,
/// or which devices there are instead of the one asked for.
class NoVulkanDevice : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All devices in the driver's order, unusable ones too. Throws NoVulkanDevice where there is no
/// loader, no driver or no device.
[[nodiscard]] std::vector<DeviceInfo> listDevices();

}  // namespace slamscope::engine
