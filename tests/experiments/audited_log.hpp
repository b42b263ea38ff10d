// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "slam/audit/audit.hpp"
#include "tests/experiments/log_conversion.hpp"

namespace slamscope::slam::experiments {

/// A run as it was logged in one way, handed to an audit record by record.
class AuditedLog {
 public:
  AuditedLog(const LogKind& kind, RunHeader header, AuditOptions options = {});

  void take(const SnapshotPtr& snapshot);
  [[nodiscard]] AuditReport report() const { return audit_.report(); }
  [[nodiscard]] const LogKind& kind() const { return kind_; }

  /// How many records had been taken, after record `from`, when the given one was (Snapshot::
  /// sequence).
  [[nodiscard]] int recordsTo(std::uint64_t sequence, std::uint64_t from = 0) const;

 private:
  LogKind kind_;
  Audit audit_;
  std::vector<std::uint64_t> sequences_;
};

/// First record at which evidence of these classes stands in the report.
[[nodiscard]] std::optional<std::uint64_t> firstRecord(const AuditReport& report,
                                                       const std::set<FaultClass>& classes);

/// Features that the report pins the fault on, by the laws of these classes: those with at least
/// `least_share` of the largest share of their law.
[[nodiscard]] std::set<FeatureId> blamed(const AuditReport& report,
                                         const std::set<FaultClass>& classes,
                                         double least_share = 0.0);

}  // namespace slamscope::slam::experiments
