// SPDX-License-Identifier: MIT
#include <cstdio>
#include <map>
#include <mutex>

#include "slam/parallel.hpp"
#include "tests/experiments/audited_log.hpp"
#include "tests/experiments/healthy_run.hpp"
#include "tests/experiments/healthy_table.hpp"
#include "tests/experiments/progress.hpp"
#include "tests/slam/variants/variants.hpp"

namespace slamscope::slam::experiments {
namespace {

struct Tally {
  int runs = 0;
  int code = 0;                                        ///< without a word
  int named = 0;                                       ///< of these, the word stands in the report
  int code_allowed = 0;                                ///< with its word
  int statistics = 0, linearisation = 0;               ///< with its word
  std::map<std::string_view, int> laws, laws_allowed;  ///< of class code
};

void countLaws(const AuditReport& report, std::map<std::string_view, int>& laws) {
  for (const LawReport& law : report.laws) {
    if (law.status == LawStatus::violated && law.fault_class == FaultClass::code) {
      ++laws[lawName(law.law)];
    }
  }
}

bool names(const AuditReport& report, std::string_view word) {
  for (const std::string& hint : report.hints) {
    if (hint.find(word) != std::string::npos) return true;
  }
  return false;
}

HealthyRun variantRun(const testing::Variant& variant, UpdateMode update, std::uint64_t seed) {
  HealthyRun run;
  run.variant = variant.name;
  run.simulation.seed = seed;
  run.simulation.update = update;
  run.simulation.loops = 2;
  if (variant.needs_loose_start) run.simulation.initial_sigma = {0.05, 0.05, 0.004};
  return run;
}

void auditOne(const HealthyRun& run, std::string_view word, Tally& tally, std::mutex& mutex) {
  std::vector<AuditedLog> logs;
  runHealthy(
      run,
      [&](const RunHeader& header) {
        AuditOptions allowing;
        if (!word.empty()) allowing.allow = {allowFromName(word)};
        logs.emplace_back(LogKind{}, header);
        logs.emplace_back(LogKind{}, header, allowing);
      },
      [&](const SnapshotPtr& snapshot) {
        for (AuditedLog& log : logs) log.take(snapshot);
      });
  const AuditReport plain = logs[0].report();
  const AuditReport allowed = logs[1].report();
  const std::lock_guard lock(mutex);
  ++tally.runs;
  tally.code += plain.found(FaultClass::code) ? 1 : 0;
  tally.named += names(plain, word) ? 1 : 0;
  tally.code_allowed += allowed.found(FaultClass::code) ? 1 : 0;
  tally.statistics += allowed.found(FaultClass::statistics) ? 1 : 0;
  tally.linearisation += allowed.found(FaultClass::linearisation) ? 1 : 0;
  countLaws(plain, tally.laws);
  countLaws(allowed, tally.laws_allowed);
}

std::string text(const std::map<std::string_view, int>& laws) {
  std::string all;
  for (const auto& [law, runs] : laws) {
    all += (all.empty() ? "" : ", ") + std::string(law) + " " + std::to_string(runs);
  }
  return all.empty() ? "none" : all;
}

}  // namespace

int printVariantTable(const HealthyTableOptions& options) {
  constexpr std::array kUpdates{UpdateMode::sequential, UpdateMode::batch};
  std::vector<testing::Variant> variants;
  for (const testing::Variant& variant : testing::kVariants) {
    if (options.only.empty() || variant.name == options.only) variants.push_back(variant);
  }
  std::vector<Tally> tallies(variants.size() * kUpdates.size());
  const int runs = static_cast<int>(tallies.size()) * options.runs;
  {
    Progress progress("lawful variants", runs);
    std::mutex mutex;
    parallelFor(runs, options.threads, [&](int k) {
      const auto row = static_cast<std::size_t>(k / options.runs);
      const testing::Variant& variant = variants[row / kUpdates.size()];
      const UpdateMode update = kUpdates[row % kUpdates.size()];
      const auto seed = options.first + static_cast<std::uint64_t>(k % options.runs);
      auditOne(variantRun(variant, update, seed), variant.allow, tallies[row], mutex);
      progress.done();
    });
  }
  std::printf("\nLawful variants: L2 double, %d runs a row\n", options.runs);
  std::printf("%-16s %-10s %-22s %12s %6s %9s %10s %13s  %s\n", "variant", "update", "--allow",
              "code without", "named", "code with", "statistics", "linearisation", "laws broken");
  int code = 0;
  for (std::size_t row = 0; row < tallies.size(); ++row) {
    const testing::Variant& variant = variants[row / kUpdates.size()];
    const bool batch = kUpdates[row % kUpdates.size()] == UpdateMode::batch;
    const Tally& t = tallies[row];
    std::printf("%-16s %-10s %-22s %12d %6d %9d %10d %13d  %s; with the word %s\n",
                variant.name.data(), batch ? "batch" : "sequential", variant.allow.data(), t.code,
                variant.allow.empty() ? 0 : t.named, t.code_allowed, t.statistics, t.linearisation,
                text(t.laws).c_str(), text(t.laws_allowed).c_str());
    code += t.code + t.code_allowed;
  }
  return code;
}

}  // namespace slamscope::slam::experiments
