// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "slam/faults.hpp"

namespace slamscope::slam {

/// A line of the catalogue with what plants it. Each theme has its file; `faults.cpp` joins them.
struct FaultEntry {
  FaultDescription description;
  std::unique_ptr<EkfEquations> (*make)(const FaultOptions&);
};

[[nodiscard]] std::span<const FaultEntry> motionFaults();       ///< faults_motion.cpp
[[nodiscard]] std::span<const FaultEntry> observationFaults();  ///< faults_observation.cpp
[[nodiscard]] std::span<const FaultEntry> covarianceFaults();   ///< faults_covariance.cpp
[[nodiscard]] std::span<const FaultEntry> statisticsFaults();   ///< faults_statistics.cpp

/// Maker of a fault that needs no more than the sensor.
template <typename Fault>
std::unique_ptr<EkfEquations> plant(const FaultOptions& options) {
  return std::make_unique<Fault>(options.sensor);
}

/// The same for a bug in the treatment of bearings.
template <typename Fault>
std::unique_ptr<EkfEquations> plantInBearing(const FaultOptions& options) {
  if (options.sensor != Sensor::range_bearing) {
    throw std::invalid_argument("this fault is one of bearings: it needs sensor range-bearing");
  }
  return std::make_unique<Fault>(options.sensor);
}

}  // namespace slamscope::slam
