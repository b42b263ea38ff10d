// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

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

}  // namespace slamscope::apps
