// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam {

/// A line of `--list-faults`.
struct FaultDescription {
  std::string_view name;
  std::string_view description;
};

/// What a fault may need to know. `features`: whose covariance `paper` spoils, by id; empty for its
/// default, features 2, 8 and 14: one in each cluster of the paper's map.
struct FaultOptions {
  Sensor sensor = Sensor::range_bearing;
  std::vector<FeatureId> features;
};

/// Every fault that can be planted in the filter, `none` first.
[[nodiscard]] std::span<const FaultDescription> faultNames();

/// The equations with the named fault in them. Throws std::invalid_argument that lists the names
/// where there is none of that name.
[[nodiscard]] std::unique_ptr<EkfEquations> makeFault(std::string_view name,
                                                      const FaultOptions& options = {});

}  // namespace slamscope::slam
