// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "slam/audit/audit.hpp"
#include "slam/recorder.hpp"
#include "slam/simulation.hpp"

namespace slamscope::slam {

/// How the log of a test is written.
struct AuditLog {
  bool every_event = true;  ///< L2, else L1
  int digits = 17;          ///< 17: double; 8: float32; else significant digits of a text
  bool observed = true;     ///< whether it says what was observed
  bool declared = true;     ///< whether the header declares R
};

inline double rounded(double value, int digits) {
  if (digits == 8) {
    // volatile: g++ 12 leaves both conversions out where it vectorises two of them.
    volatile const float single = static_cast<float>(value);
    return static_cast<double>(single);
  }
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

/// The record as a log of that kind holds it: x and P, no more (levels L1 and L2).
inline Snapshot logged(const Snapshot& snapshot, const AuditLog& log) {
  Snapshot s = snapshot;
  s.observations.clear();
  s.Q.reset();
  s.control.reset();
  s.truth.reset();
  if (!log.observed) {
    s.observed.clear();
    s.observed_given = false;
  }
  if (log.digits == 17) return s;
  for (int k = 0; k < 3; ++k) s.pose[k] = rounded(s.pose[k], log.digits);
  for (Eigen::Vector2d& f : s.features) {
    for (int k = 0; k < 2; ++k) f[k] = rounded(f[k], log.digits);
  }
  std::vector<double> packed(s.covariance.packed().begin(), s.covariance.packed().end());
  for (double& value : packed) value = rounded(value, log.digits);
  s.covariance = PackedCovariance(s.covariance.size(), std::move(packed));
  return s;
}

/// Audits a simulated run. `spoil` may change a record after it was logged.
inline AuditReport auditRun(const SimulationOptions& options, const AuditLog& log = {},
                            const std::function<void(Snapshot&)>& spoil = {},
                            AuditOptions audit_options = {}) {
  Simulation simulation(options);
  RunHeader header = simulation.header();
  if (!log.declared) header.R.reset();
  Audit audit(std::move(audit_options), header);
  const Subscription subscription = simulation.filter().observe(
      log.every_event ? kRecordAll : kRecordSteps, [&](const SnapshotPtr& snapshot) {
        auto record = std::make_shared<Snapshot>(logged(*snapshot, log));
        if (spoil) spoil(*record);
        audit.take(record);
      });
  while (simulation.step()) {
  }
  return audit.report();
}

/// The paper's set-up, one loop.
inline SimulationOptions oneLoop(std::uint64_t seed) {
  SimulationOptions options;
  options.loops = 1;
  options.seed = seed;
  return options;
}

/// Which laws are broken, for messages.
inline std::string brokenLaws(const AuditReport& report) {
  std::string text;
  for (const LawReport& law : report.laws) {
    if (law.status != LawStatus::violated) continue;
    text += std::string(lawName(law.law)) + " (record " + std::to_string(*law.first_record) + ", " +
            std::to_string(law.worst) + " > " + std::to_string(law.tolerance) + "; " + law.amount +
            ") ";
  }
  return text;
}

inline std::vector<FeatureId> blamedFeatures(const LawReport& law) {
  std::vector<FeatureId> ids;
  for (const Blame& b : law.blame) ids.push_back(b.feature);
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace slamscope::slam
