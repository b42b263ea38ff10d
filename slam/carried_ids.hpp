// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Which ids the readings of each feature carried, where association did not look at them. For
/// scores on recordings whose ids are known and only hidden from the association.
class CarriedIds {
 public:
  /// A reading of `feature` carried that id; 0, none, is not counted.
  void count(FeatureId feature, FeatureId carried);
  void forget(FeatureId feature) { counts_.erase(feature); }

  /// Feature → the id that its readings carried, for features of whose readings some carried one.
  /// Each id goes to one feature, those with most readings first; a feature for which none is left
  /// gets its own most frequent one, as a duplicate.
  [[nodiscard]] std::map<FeatureId, FeatureId> names() const;
  /// Readings that carried another id than that.
  [[nodiscard]] std::uint64_t mispaired() const;

 private:
  std::map<FeatureId, std::map<FeatureId, int>> counts_;
};

}  // namespace slamscope::slam
