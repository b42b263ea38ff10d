// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>

#include "apps/slamscope/verbs.hpp"
#include "engine/gpu/device_info.hpp"

namespace slamscope::apps {

void addDevices(CLI::App& program) {
  CLI::App* verb = program.add_subcommand("devices", "Vulkan devices that can be drawn with");
  verb->footer("Example: slamscope devices\nThen: slamscope monitor --device 0");
  verb->callback([] {
    for (const engine::DeviceInfo& device : engine::listDevices()) {
      std::printf("%d  %s  (%s, Vulkan %s, %s)%s\n", device.index, device.name.c_str(),
                  device.type.c_str(), device.api_version.c_str(), device.driver.c_str(),
                  device.lacks.empty() ? "" : ("  can't be used: " + device.lacks).c_str());
    }
  });
}

}  // namespace slamscope::apps
