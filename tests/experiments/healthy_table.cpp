// SPDX-License-Identifier: MIT
#include "tests/experiments/healthy_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>

#include "slam/parallel.hpp"
#include "tests/experiments/audited_log.hpp"
#include "tests/experiments/healthy_run.hpp"
#include "tests/experiments/progress.hpp"

namespace slamscope::slam::experiments {
namespace {

struct Tally {
  int logs = 0;
  int code = 0, statistics = 0, linearisation = 0, inconclusive = 0;
};

/// Every kind of log is met as the numbers go by; two of them always.
std::vector<LogKind> kindsFor(std::uint64_t number) {
  const Precision precision = kPrecisions[number % 3];
  const bool declared = number % 2 == 0;
  std::vector<LogKind> kinds{{Level::l1, Precision::exact},
                             {Level::l2, Precision::exact, declared}};
  if (precision == Precision::exact) {
    kinds.push_back({Level::l3, Precision::exact, true, declared});
  } else {
    kinds.push_back({Level::l1, precision});
    kinds.push_back({Level::l2, precision, declared});
  }
  return kinds;
}

std::string complaint(const LawReport& law) {
  char text[200];
  std::snprintf(text, sizeof text, "%s (%llu of %llu, worst %.3g, tolerance %.3g, record %lld)",
                std::string(lawName(law.law)).c_str(),
                static_cast<unsigned long long>(law.violations),
                static_cast<unsigned long long>(law.checked), law.worst, law.tolerance,
                law.first_record ? static_cast<long long>(*law.first_record) : -1LL);
  return text;
}

/// What the audit held against a run, in a line a law.
std::string complaints(const AuditReport& report) {
  std::string text;
  for (const LawReport& law : report.laws) {
    if (law.status != LawStatus::violated || !law.fault_class) continue;
    text += "\n      " + std::string(faultClassName(*law.fault_class)) + ": " + complaint(law);
  }
  return text;
}

struct Findings {
  std::mutex mutex;
  std::map<std::string, Tally> tallies;                          ///< by kind of log
  std::map<std::uint64_t, std::vector<std::string>> complaints;  ///< by number of the run

  void count(const AuditedLog& log, const HealthyRun& run) {
    const AuditReport report = log.report();
    const std::lock_guard lock(mutex);
    Tally& tally = tallies[kindName(log.kind())];
    ++tally.logs;
    tally.code += report.found(FaultClass::code) ? 1 : 0;
    tally.statistics += report.found(FaultClass::statistics) ? 1 : 0;
    tally.linearisation += report.found(FaultClass::linearisation) ? 1 : 0;
    tally.inconclusive += report.verdict == Verdict::inconclusive ? 1 : 0;
    if (!report.found(FaultClass::code) && !report.found(FaultClass::statistics)) return;
    complaints[run.simulation.seed].push_back(kindName(log.kind()) + ", " + run.describe() +
                                              experiments::complaints(report));
  }
};

void auditOne(const HealthyRun& run, const std::vector<LogKind>& kinds, AuditOptions audit,
              const std::function<void(const AuditedLog&)>& done) {
  std::vector<AuditedLog> logs;
  runHealthy(
      run,
      [&](const RunHeader& header) {
        for (const LogKind& kind : kinds) logs.emplace_back(kind, header, audit);
      },
      [&](const SnapshotPtr& snapshot) {
        for (AuditedLog& log : logs) log.take(snapshot);
      });
  for (const AuditedLog& log : logs) done(log);
}

}  // namespace

int printHealthyTable(const HealthyTableOptions& options) {
  Findings findings;
  {
    Progress progress("healthy runs", options.runs);
    parallelFor(options.runs, options.threads, [&](int k) {
      const std::uint64_t number = options.first + static_cast<std::uint64_t>(k);
      const HealthyRun run = drawHealthyRun(number);
      AuditOptions audit;
      audit.alpha = options.alpha;
      auditOne(run, kindsFor(number), audit,
               [&](const AuditedLog& log) { findings.count(log, run); });
      progress.done();
    });
  }
  std::printf("\nHealthy runs: %d, alpha %g\n", options.runs, options.alpha);
  std::printf("%-28s %6s %6s %11s %24s %14s %13s\n", "log", "logs", "code", "statistics",
              "expected by alpha", "linearisation", "inconclusive");
  int code = 0;
  for (const auto& [kind, tally] : findings.tallies) {
    const double expected = options.alpha * tally.logs;
    std::printf("%-28s %6d %6d %11d %15.2f +- %5.2f %14d %13d\n", kind.c_str(), tally.logs,
                tally.code, tally.statistics, expected, std::sqrt(expected * (1.0 - options.alpha)),
                tally.linearisation, tally.inconclusive);
    code += tally.code;
  }
  for (const auto& [number, lines] : findings.complaints) {
    for (const std::string& line : lines) std::printf("  %s\n", line.c_str());
  }
  return code;
}

}  // namespace slamscope::slam::experiments
