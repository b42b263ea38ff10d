// SPDX-License-Identifier: MIT
#include "slam/run_summary.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace slamscope::slam {
namespace {

/// What the records must have for a level, gathered over the run.
struct Evidence {
  bool means = false;         ///< some mean is a number
  bool full = true;           ///< every record has more than the diagonal
  bool observations = false;  ///< z, innovation, S were logged
};

bool hasMeans(const Snapshot& snapshot) {
  const auto known = [](double value) { return !std::isnan(value); };
  return std::any_of(snapshot.pose.begin(), snapshot.pose.end(), known) ||
         std::any_of(snapshot.features.begin(), snapshot.features.end(),
                     [&](const Eigen::Vector2d& point) { return known(point.x()); });
}

bool isFinite(const Snapshot& snapshot, bool means_known) {
  if (means_known) return snapshot.finite();
  const auto packed = snapshot.covariance.packed();
  return std::all_of(packed.begin(), packed.end(),
                     [](double value) { return std::isfinite(value); });
}

/// The table of levels; see RunLevel.
RunLevel levelOf(const RunSummary& summary, const Evidence& evidence) {
  if (summary.records == 0) return RunLevel::L1;
  if (!evidence.means) return RunLevel::LC;
  if (!evidence.full) return RunLevel::L0;
  const bool every_event = summary.count(Event::update) != 0 && summary.count(Event::predict) != 0;
  if (!every_event) return RunLevel::L1;
  return evidence.observations ? RunLevel::L3 : RunLevel::L2;
}

void add(RunSummary& summary, Evidence& evidence, const Snapshot& snapshot) {
  if (summary.records == 0) summary.first = snapshot.time;
  if (summary.records == 0 || snapshot.time != summary.last) ++summary.steps;
  summary.last = snapshot.time;
  ++summary.events[static_cast<std::size_t>(snapshot.event)];
  summary.features_at_end = snapshot.featureCount();
  summary.features_at_most = std::max(summary.features_at_most, snapshot.featureCount());
  if (!snapshot.extra.empty()) summary.extra = snapshot.extra;
  if (!summary.first_not_finite && !isFinite(snapshot, summary.header.means_known)) {
    summary.first_not_finite = summary.records;
  }
  if (snapshot.asymmetry) {
    summary.worst_asymmetry = std::max(summary.worst_asymmetry.value_or(0.0), *snapshot.asymmetry);
  }
  summary.truth |= snapshot.truth.has_value();
  summary.observed |= snapshot.observed_given;
  evidence.means |= hasMeans(snapshot);
  evidence.full &= !snapshot.diagonal_only;
  evidence.observations |= std::any_of(
      snapshot.observations.begin(), snapshot.observations.end(),
      [](const ObservationRecord& record) { return record.S != Eigen::Matrix2d::Zero(); });
  ++summary.records;
}

}  // namespace

std::string RunSummary::levelName() const {
  constexpr std::array<const char*, 5> kNames{"LC", "L0", "L1", "L2", "L3"};
  return std::string(kNames.at(static_cast<std::size_t>(level))) +
         (truth ? ", with truth (L4)" : "");
}

RunSummary summarize(RunReader& reader) {
  RunSummary summary;
  summary.header = reader.header();
  Evidence evidence;
  std::unordered_set<FeatureId> features;
  while (const auto snapshot = reader.next()) {
    add(summary, evidence, **snapshot);
    features.insert((*snapshot)->ids.begin(), (*snapshot)->ids.end());
  }
  summary.different_features = features.size();
  summary.level = levelOf(summary, evidence);
  summary.warnings = reader.warnings();
  return summary;
}

}  // namespace slamscope::slam
