// SPDX-License-Identifier: MIT
#include "tests/experiments/fault_table.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <mutex>

#include "slam/parallel.hpp"
#include "tests/experiments/audited_log.hpp"
#include "tests/experiments/planted_run.hpp"
#include "tests/experiments/progress.hpp"

namespace slamscope::slam::experiments {
namespace {

/// What the audit said of all seeds of one row and one kind of log.
struct Tally {
  int runs = 0;
  int detected = 0;  ///< with the least class that must be found
  int code = 0, statistics = 0, linearisation = 0;
  std::vector<int> records;  ///< from where the fault begins to its first finding
  int exact_blame = 0;
  double f1 = 0.0;
  std::map<std::string_view, int> laws;
};

double f1Score(const std::set<FeatureId>& truth, const std::set<FeatureId>& found) {
  const auto hits =
      std::count_if(found.begin(), found.end(), [&](FeatureId id) { return truth.contains(id); });
  const auto all = truth.size() + found.size();
  return all == 0 ? 1.0 : 2.0 * static_cast<double>(hits) / static_cast<double>(all);
}

std::vector<LogKind> kindsFor(const FaultDescription& fault) {
  std::vector<LogKind> kinds;
  for (const Level level : {Level::l1, Level::l2}) {
    for (const Precision precision : kPrecisions) kinds.push_back({level, precision});
  }
  if (fault.code_where_declared) kinds.push_back({Level::l2, Precision::exact, true});
  return kinds;
}

/// The classes that count as having found it: where statistics are enough, code is no error.
std::set<FaultClass> wanted(const FaultDescription& fault, const LogKind& kind) {
  const bool code = fault.kind == FaultKind::code || (kind.declared && fault.code_where_declared);
  return code ? std::set{FaultClass::code} : std::set{FaultClass::code, FaultClass::statistics};
}

void count(Tally& tally, const AuditedLog& log, const FaultDescription& fault,
           const PlantedTruth& truth) {
  const AuditReport report = log.report();
  const std::set<FaultClass> classes = wanted(fault, log.kind());
  ++tally.runs;
  tally.code += report.found(FaultClass::code) ? 1 : 0;
  tally.statistics += report.found(FaultClass::statistics) ? 1 : 0;
  tally.linearisation += report.found(FaultClass::linearisation) ? 1 : 0;
  for (const LawReport& law : report.laws) {
    if (law.status == LawStatus::violated) ++tally.laws[lawName(law.law)];
  }
  const bool detected =
      std::any_of(classes.begin(), classes.end(), [&](FaultClass c) { return report.found(c); });
  if (!detected) return;
  ++tally.detected;
  if (const auto first = firstRecord(report, classes); first && *first >= truth.begins) {
    tally.records.push_back(log.recordsTo(*first, truth.begins));
  }
  const std::set<FeatureId> found = blamed(report, classes);
  tally.exact_blame += found == truth.features ? 1 : 0;
  tally.f1 += f1Score(truth.features, found);
}

std::string percent(int part, int whole) {
  return whole == 0 ? "-" : std::to_string((200 * part + whole) / (2 * whole)) + " %";
}

std::string lawsOf(const Tally& tally) {
  std::vector<std::pair<int, std::string_view>> laws;
  for (const auto& [law, runs] : tally.laws) laws.emplace_back(-runs, law);
  std::sort(laws.begin(), laws.end());
  std::string text;
  for (const auto& [runs, law] : laws) {
    text += (text.empty() ? "" : ", ") + std::string(law) + " " + percent(-runs, tally.runs);
  }
  return text;
}

void printRow(const std::string& name, UpdateMode update, const FaultDescription& fault,
              const LogKind& kind, Tally tally) {
  std::sort(tally.records.begin(), tally.records.end());
  const std::string median =
      tally.records.empty() ? "-" : std::to_string(tally.records[tally.records.size() / 2]);
  const bool blames = fault.blame == FaultBlame::chosen_features ||
                      fault.blame == FaultBlame::new_features ||
                      fault.blame == FaultBlame::written_block;
  char f1[16] = "-";
  if (blames && tally.detected > 0) std::snprintf(f1, sizeof f1, "%.2f", tally.f1 / tally.detected);
  std::printf(
      "%-27s %-10s %-21s %8s %7s  %5s/%5s/%5s  %6s %5s  %s\n", name.c_str(),
      update == UpdateMode::batch ? "batch" : "sequential", kindName(kind).c_str(),
      percent(tally.detected, tally.runs).c_str(), median.c_str(),
      percent(tally.code, tally.runs).c_str(), percent(tally.statistics, tally.runs).c_str(),
      percent(tally.linearisation, tally.runs).c_str(),
      blames ? percent(tally.exact_blame, tally.runs).c_str() : "-", f1, lawsOf(tally).c_str());
}

struct Row {
  Planted planted;
  UpdateMode update;
  std::vector<LogKind> kinds;
  std::vector<Tally> tallies;
};

std::vector<Row> rowsOf(const FaultTableOptions& options) {
  std::vector<Row> rows;
  for (const Planted& planted : plantedFaults()) {
    const auto chosen = std::find(options.faults.begin(), options.faults.end(), planted.fault);
    if (!options.faults.empty() && chosen == options.faults.end()) continue;
    const std::vector<LogKind> kinds = kindsFor(faultNamed(planted.fault));
    for (const UpdateMode update : {UpdateMode::sequential, UpdateMode::batch}) {
      rows.push_back({planted, update, kinds, std::vector<Tally>(kinds.size())});
    }
  }
  return rows;
}

void auditOne(Row& row, std::uint64_t seed, double alpha, std::mutex& mutex) {
  std::vector<AuditedLog> logs;
  const PlantedTruth truth = runPlanted(
      row.planted, row.update, seed,
      [&](const RunHeader& header) {
        for (const LogKind& kind : row.kinds) {
          AuditOptions options;
          options.alpha = alpha;
          logs.emplace_back(kind, header, options);
        }
      },
      [&](const SnapshotPtr& snapshot) {
        for (AuditedLog& log : logs) log.take(snapshot);
      });
  const std::lock_guard lock(mutex);
  for (std::size_t k = 0; k < logs.size(); ++k) {
    count(row.tallies[k], logs[k], faultNamed(row.planted.fault), truth);
  }
}

}  // namespace

void printFaultTable(const FaultTableOptions& options) {
  std::vector<Row> rows = rowsOf(options);
  const int runs = static_cast<int>(rows.size()) * options.seeds;
  {
    Progress progress("faulty runs", runs);
    std::mutex mutex;
    parallelFor(runs, options.threads, [&](int k) {
      Row& row = rows[static_cast<std::size_t>(k / options.seeds)];
      const auto seed = options.first_seed + static_cast<std::uint64_t>(k % options.seeds);
      auditOne(row, seed, options.alpha, mutex);
      progress.done();
    });
  }
  std::printf("Planted faults: %d seeds a row, paper's map, 3 loops, alpha %g\n", options.seeds,
              options.alpha);
  std::printf("%-27s %-10s %-21s %8s %7s  %17s  %6s %5s  %s\n", "fault", "update", "log",
              "detected", "records", "code/stat/linear", "blamed", "F1",
              "laws broken, share of runs");
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.kinds.size(); ++k) {
      printRow(row.planted.name, row.update, faultNamed(row.planted.fault), row.kinds[k],
               row.tallies[k]);
    }
  }
}

}  // namespace slamscope::slam::experiments
