// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam {

/// The least that an audit must find: an exact law broken, or χ² evidence only.
enum class FaultKind { none, code, statistics };

/// Whom an audit must name.
enum class FaultBlame {
  nobody,
  chosen_features,  ///< those of FaultOptions::features
  new_features,     ///< each feature that was initialised
  written_block,    ///< the feature whose block of H is written
  jacobian_entry,   ///< the entry of F
};

/// A line of `--list-faults`, and of the table of the catalogue.
struct FaultDescription {
  std::string_view name;
  std::string_view description;
  FaultKind kind = FaultKind::none;
  int level = 1;  ///< from which level of the log (L1, L2) it can be found
  FaultBlame blame = FaultBlame::nobody;
  bool code_where_declared = false;  ///< found as code where the log declares R (or Q)
  std::string_view shipped_by =
      {};  ///< public project that had this bug, empty where none is known
};

/// What a fault may need to know.
struct FaultOptions {
  Sensor sensor = Sensor::range_bearing;
  /// Whose covariance `paper` spoils, which ones `moved-feature` moves, by id. Empty: 2, 8 and 14,
  /// one in each cluster of the paper's map.
  std::vector<FeatureId> features{};
  std::uint64_t seed = 1;  ///< of what `wrong-association` draws
};

/// Every fault that can be planted, `none` first: 24 faults and the correct filter.
[[nodiscard]] std::span<const FaultDescription> faultNames();

/// The named line of the catalogue. Throws std::invalid_argument that lists the names where there
/// is none of that name.
[[nodiscard]] const FaultDescription& faultNamed(std::string_view name);

/// The equations with the named fault in them; the correct ones for a fault of the world. Throws
/// std::invalid_argument that lists the names where there is none of that name, and where the fault
/// is one of bearings and the sensor has none.
[[nodiscard]] std::unique_ptr<EkfEquations> makeFault(std::string_view name,
                                                      const FaultOptions& options = {});

/// A fault of the world instead of the filter: features that leave their place, straight away from
/// the loop's centre. The simulation does it.
struct FeatureMove {
  double at = 0.5;        ///< share of the run, 0 … 1
  double distance = 0.3;  ///< m
};

/// What the named fault moves; absent for faults of the filter.
[[nodiscard]] std::optional<FeatureMove> featureMove(std::string_view name);

}  // namespace slamscope::slam
