// SPDX-License-Identifier: MIT
#include "slam/faults.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "slam/fault_entry.hpp"

namespace slamscope::slam {
namespace {

constexpr std::string_view kMovedFeature = "moved-feature";

constexpr FaultEntry kCorrectFilter{{"none", "a correct filter"}, plant<EkfEquations>};

constexpr FaultEntry kWorldFault{{kMovedFeature, "a feature is moved by 0.3 m half-way",
                                  FaultKind::statistics, 1, FaultBlame::chosen_features},
                                 plant<EkfEquations>};

struct Catalogue {
  std::vector<FaultDescription> descriptions;
  std::vector<FaultEntry> entries;

  Catalogue() {
    add(kCorrectFilter);
    for (const auto& theme :
         {covarianceFaults(), motionFaults(), observationFaults(), statisticsFaults()}) {
      for (const FaultEntry& entry : theme) add(entry);
    }
    add(kWorldFault);
  }

  void add(const FaultEntry& entry) {
    descriptions.push_back(entry.description);
    entries.push_back(entry);
  }
};

const Catalogue& catalogue() {
  static const Catalogue kAll;
  return kAll;
}

std::size_t indexOf(std::string_view name) {
  const auto& all = catalogue().descriptions;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const auto& known) { return known.name == name; });
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  std::string known;
  for (const FaultDescription& fault : all) {
    known += (known.empty() ? "" : ", ") + std::string(fault.name);
  }
  throw std::invalid_argument("no fault of the name '" + std::string(name) + "'; known: " + known);
}

}  // namespace

std::span<const FaultDescription> faultNames() {
  return catalogue().descriptions;
}

const FaultDescription& faultNamed(std::string_view name) {
  return catalogue().descriptions[indexOf(name)];
}

std::unique_ptr<EkfEquations> makeFault(std::string_view name, const FaultOptions& options) {
  return catalogue().entries[indexOf(name)].make(options);
}

std::optional<FeatureMove> featureMove(std::string_view name) {
  if (name != kMovedFeature) return std::nullopt;
  return FeatureMove{};
}

}  // namespace slamscope::slam
