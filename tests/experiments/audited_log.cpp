// SPDX-License-Identifier: MIT
#include "tests/experiments/audited_log.hpp"

#include <algorithm>

namespace slamscope::slam::experiments {
namespace {

RunHeader headerOf(RunHeader header, const LogKind& kind) {
  if (!kind.declared) header.R.reset();
  return header;
}

bool counts(const LawReport& law, const std::set<FaultClass>& classes) {
  return law.status == LawStatus::violated && law.fault_class && classes.contains(*law.fault_class);
}

}  // namespace

AuditedLog::AuditedLog(const LogKind& kind, RunHeader header, AuditOptions options)
    : kind_(kind), audit_(std::move(options), headerOf(std::move(header), kind)) {}

void AuditedLog::take(const SnapshotPtr& snapshot) {
  const SnapshotPtr log = logged(snapshot, kind_);
  if (!log) return;
  sequences_.push_back(log->sequence);
  audit_.take(log);
}

int AuditedLog::recordsTo(std::uint64_t sequence, std::uint64_t from) const {
  const auto begin = std::lower_bound(sequences_.begin(), sequences_.end(), from);
  const auto end = std::upper_bound(sequences_.begin(), sequences_.end(), sequence);
  return static_cast<int>(end - begin);
}

std::optional<std::uint64_t> firstRecord(const AuditReport& report,
                                         const std::set<FaultClass>& classes) {
  std::optional<std::uint64_t> first;
  for (const LawReport& law : report.laws) {
    if (counts(law, classes) && law.first_record && (!first || *law.first_record < *first)) {
      first = law.first_record;
    }
  }
  return first;
}

std::set<FeatureId> blamed(const AuditReport& report, const std::set<FaultClass>& classes,
                           double least_share) {
  std::set<FeatureId> features;
  for (const LawReport& law : report.laws) {
    if (!counts(law, classes) || law.blame.empty()) continue;
    for (const Blame& blame : law.blame) {
      if (blame.share >= least_share * law.blame.front().share) features.insert(blame.feature);
    }
  }
  return features;
}

}  // namespace slamscope::slam::experiments
