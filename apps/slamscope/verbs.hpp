// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace CLI {
class App;
}

// The verbs of the command line, each in a file of its own. A verb adds its subcommand; the
// subcommand's callback does the work and throws std::exception where the request can't be met.
namespace slamscope::apps {

void addSimulate(CLI::App& program);
void addSlam(CLI::App& program);
void addAudit(CLI::App& program);
void addInfo(CLI::App& program);
void addConvert(CLI::App& program);
void addMonitor(CLI::App& program);
void addDemo(CLI::App& program);
void addCalibrate(CLI::App& program);
void addDevices(CLI::App& program);
void addHmd(CLI::App& program);
void addDisplays(CLI::App& program);

using AddVerb = void (*)(CLI::App& program);

/// The verbs of this build, in the order of the help.
std::vector<AddVerb> verbs();

}  // namespace slamscope::apps
