// SPDX-License-Identifier: MIT
#include "slam/carried_ids.hpp"

#include <algorithm>
#include <set>
#include <vector>

namespace slamscope::slam {

void CarriedIds::count(FeatureId feature, FeatureId carried) {
  if (carried != 0) ++counts_[feature][carried];
}

std::map<FeatureId, FeatureId> CarriedIds::names() const {
  struct Votes {
    int count;
    FeatureId feature, carried;
  };
  std::vector<Votes> all;
  for (const auto& [id, ids] : counts_) {
    for (const auto& [carried, times] : ids) all.push_back({times, id, carried});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Votes& a, const Votes& b) { return a.count > b.count; });
  std::map<FeatureId, FeatureId> names;
  std::set<FeatureId> given;
  for (const Votes& votes : all) {
    if (names.contains(votes.feature) || !given.insert(votes.carried).second) continue;
    names[votes.feature] = votes.carried;
  }
  for (const Votes& votes : all) names.try_emplace(votes.feature, votes.carried);
  return names;
}

std::uint64_t CarriedIds::mispaired() const {
  std::uint64_t count = 0;
  for (const auto& [id, name] : names()) {
    for (const auto& [carried, times] : counts_.at(id)) {
      if (carried != name) count += static_cast<std::uint64_t>(times);
    }
  }
  return count;
}

}  // namespace slamscope::slam
