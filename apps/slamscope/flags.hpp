// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include "apps/lib/simulation_flags.hpp"

// Flags that several verbs share.
namespace slamscope::apps {

/// World, robot, noise, fault and filter of a simulation.
void addSimulationFlags(CLI::App& verb, SimulationFlags& flags);

/// Prints the faults that can be planted, a line each.
void listFaults();

}  // namespace slamscope::apps
