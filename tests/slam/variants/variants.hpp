// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam::testing {

struct Compass {
  double heading = 0.0;  ///< rad, with its noise
  double sigma = 0.02;   ///< rad
};

/// A correct filter that is not the plain EKF.
struct Variant {
  std::string_view name;
  /// The word of `--allow` that it needs; empty where it is lawful without one.
  std::string_view allow;
  bool needs_loose_start = false;  ///< P must be regular
  bool sequential_only = false;    ///< no different from the plain EKF in batches
};

inline constexpr std::array kVariants = {
    Variant{"plain", ""},
    Variant{"joseph", ""},
    Variant{"square-root", ""},
    Variant{"information", "", true},
    Variant{"unscented", ""},
    Variant{"iterated", "iterated"},
    Variant{"first-estimates", "fej"},
    Variant{"frozen", "frozen-linearisation", false, true},
    Variant{"diffuse", "diffuse-initialisation"},
    Variant{"compass", "absolute-sensor"},
};

/// `compass` is read by the variant of that name.
std::unique_ptr<EkfEquations> makeVariant(std::string_view name, Sensor sensor,
                                          std::shared_ptr<const Compass> compass);

}  // namespace slamscope::slam::testing
