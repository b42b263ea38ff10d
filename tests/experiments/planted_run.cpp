// SPDX-License-Identifier: MIT
#include "tests/experiments/planted_run.hpp"

#include "slam/simulation_random.hpp"

namespace slamscope::slam::experiments {
namespace {

std::vector<FeatureId> drawFeatures(int count, int of, std::uint64_t seed) {
  RandomSource random(seed * 7919 + 17);
  std::set<FeatureId> drawn;
  while (static_cast<int>(drawn.size()) < count) {
    drawn.insert(1 + static_cast<FeatureId>(random.uniform() * of));
  }
  return {drawn.begin(), drawn.end()};
}

/// Watches a run for whom it would be right to blame.
class Witness {
 public:
  Witness(FaultBlame blame, const std::vector<FeatureId>& chosen) : blame_(blame) {
    if (blame == FaultBlame::chosen_features) features.insert(chosen.begin(), chosen.end());
  }

  void hear(const Snapshot& snapshot) {
    if (blame_ == FaultBlame::new_features && snapshot.event == Event::initialise) {
      // Features that are born where the pose is exactly known are lawfully uncorrelated.
      if (snapshot.covariance(0, 0) > 0.0) features.insert(snapshot.observed.at(0));
    }
    if (blame_ == FaultBlame::written_block && snapshot.event == Event::update) {
      for (const FeatureId id : snapshot.observed) features.insert(writtenFor(snapshot, id));
    }
  }

  std::set<FeatureId> features;

 private:
  static FeatureId writtenFor(const Snapshot& snapshot, FeatureId id) {
    const auto index = static_cast<std::size_t>(snapshot.indexOf(id).value());
    if (index + 1 < snapshot.ids.size()) return snapshot.ids[index + 1];
    return snapshot.ids[index > 0 ? index - 1 : 0];
  }

  FaultBlame blame_;
};

}  // namespace

std::vector<Planted> plantedFaults() {
  std::vector<Planted> all;
  for (const FaultDescription& fault : faultNames().subspan(1)) {
    const std::string name(fault.name);
    if (name == "paper") {
      all.insert(all.end(),
                 {{"paper (1)", name, 1}, {"paper (2)", name, 2}, {"paper (5)", name, 5}});
    } else {
      all.push_back({name, name, 1});
    }
  }
  return all;
}

PlantedTruth runPlanted(const Planted& planted, UpdateMode update, std::uint64_t seed,
                        const std::function<void(const RunHeader&)>& begin,
                        const std::function<void(const SnapshotPtr&)>& hear) {
  SimulationOptions options;
  options.fault = planted.fault;
  options.seed = seed;
  options.update = update;
  options.fault_features = drawFeatures(planted.features, options.features, seed);
  Simulation simulation(options);
  begin(simulation.header());
  Witness witness(faultNamed(planted.fault).blame, options.fault_features);
  PlantedTruth truth;
  const Subscription subscription = simulation.filter().observe([&](const SnapshotPtr& snapshot) {
    const auto& move = featureMove(planted.fault);
    if (move && simulation.progress() < move->at) truth.begins = snapshot->sequence + 1;
    witness.hear(*snapshot);
    hear(snapshot);
  });
  while (simulation.step()) {
  }
  truth.features = witness.features;
  return truth;
}

}  // namespace slamscope::slam::experiments
