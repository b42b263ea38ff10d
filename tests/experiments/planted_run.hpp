// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <set>
#include <string>

#include "slam/faults.hpp"
#include "slam/simulation.hpp"

namespace slamscope::slam::experiments {

/// A row of the catalogue as it is tested; `paper` has several.
struct Planted {
  std::string name;  ///< of the row
  std::string fault;
  int features = 1;  ///< how many are spoilt
};

/// The 24 faults, `paper` with one, two and five features.
[[nodiscard]] std::vector<Planted> plantedFaults();

/// What the audit is to find out.
struct PlantedTruth {
  std::set<FeatureId> features;  ///< to be blamed
  std::uint64_t begins = 0;      ///< first record (Snapshot::sequence) that can be wrong
};

/// Runs the paper's experiment with the fault in it, hands every snapshot to `hear` and returns
/// whom it would be right to blame. Which features are spoilt is drawn from the seed.
PlantedTruth runPlanted(const Planted& planted, UpdateMode update, std::uint64_t seed,
                        const std::function<void(const RunHeader&)>& begin,
                        const std::function<void(const SnapshotPtr&)>& hear);

}  // namespace slamscope::slam::experiments
