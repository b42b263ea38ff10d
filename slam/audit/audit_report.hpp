// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// The laws, in the order of the report (spec audit.md).
enum class Law {
  finite,
  symmetric,
  positive,
  shrink,
  support,
  rank,
  range,
  map_still,
  motion,
  process_noise,
  initialise,
  nis,
  sensor_noise,
  heading_floor,
  whiteness,
  nis_given,
  jacobian_given,
  nees,
};
inline constexpr int kLawCount = 18;

/// `finite`, `map-still`, …
[[nodiscard]] std::string_view lawName(Law law);

/// What kind of evidence: an exact law is broken; χ² only; or the EKF's own inconsistency.
enum class FaultClass { code, statistics, linearisation };

/// `code`, `statistics`, `linearisation`: the words of `--fail-on`. The second throws
/// std::invalid_argument that lists them.
[[nodiscard]] std::string_view faultClassName(FaultClass fault_class);
[[nodiscard]] FaultClass faultClassFromName(std::string_view name);

/// Violated where a law was broken in any record; not checkable where it was not broken and no
/// record could be checked.
enum class LawStatus { ok, violated, not_checkable };
/// `ok`, `violated`, `not-checkable`.
[[nodiscard]] std::string_view lawStatusName(LawStatus status);

/// A feature and its share (0 … 1, all together 1) of the violations of a law.
struct Blame {
  FeatureId feature = 0;
  double share = 0.0;
};

/// The offending number beside the one that the law demands, from the worst record.
enum class LawfulIs { exactly, at_most, at_least };

struct Evidence {
  std::string what;  ///< "F(1,3)", "P of feature 7, var x", …
  double given = 0.0;
  double lawful = 0.0;
  LawfulIs lawful_is = LawfulIs::exactly;
};

struct LawReport {
  Law law = Law::finite;
  LawStatus status = LawStatus::not_checkable;
  std::optional<FaultClass> fault_class;      ///< where violated
  std::optional<std::uint64_t> first_record;  ///< Snapshot::sequence of the first violation
  std::optional<double> first_time_s;         ///< and its time
  std::uint64_t violations = 0;               ///< records that break it
  std::uint64_t checked = 0;                  ///< records that could be checked
  double worst = 0.0;                         ///< largest residual, in the law's own scaled unit
  double tolerance = 0.0;                     ///< what `worst` was allowed to be, in that record
  std::vector<Blame> blame;                   ///< largest share first
  std::vector<Evidence> evidence;
  std::string amount;  ///< the worst violation in words; empty where whole
  std::string reason;  ///< why it could not be checked, or was not in some records
};

enum class Verdict { ok, violation, inconclusive };
/// `ok` is said from so many checked corrections on; of less it is `inconclusive`. About as many
/// updates by one feature each are what the statistical laws need to see an R that is ten times too
/// large; exact laws need one.
inline constexpr std::uint64_t kFewestCorrections = 10;
/// `ok`, `violation`, `inconclusive`.
[[nodiscard]] std::string_view verdictName(Verdict verdict);

struct AuditReport {
  Verdict verdict = Verdict::inconclusive;
  std::set<FaultClass> classes;  ///< found, never mixed
  std::string level;             ///< "L2", or with truth "L2+L4"
  std::string precision;         ///< of the numbers in the log: "double", "float32", "6 digits"
  std::uint64_t records = 0;
  std::uint64_t updates = 0;  ///< transitions in which something was observed, as far as known
  /// Updates, or whole time steps where updates are not logged, in which a law that compares with
  /// the record before could be checked.
  std::uint64_t corrections_checked = 0;
  double first_time_s = 0.0;
  double last_time_s = 0.0;
  double alpha = 1e-3;
  std::vector<LawReport> laws;          ///< one of each law, in order
  std::vector<std::string> likely;      ///< programming mistakes that fit, most likely first
  std::vector<std::string> hints;       ///< fitting words of --allow and why
  std::vector<std::string> next_level;  ///< lines to add to one's filter for the next level

  [[nodiscard]] const LawReport& law(Law law) const {
    return laws.at(static_cast<std::size_t>(law));
  }
  [[nodiscard]] bool found(FaultClass fault_class) const { return classes.contains(fault_class); }
};

/// Exit status of `slamscope audit`: 1 where a class of `fail_on` was found, 3 where there was too
/// little to judge, else 0.
[[nodiscard]] int exitStatus(const AuditReport& report,
                             const std::set<FaultClass>& fail_on = {FaultClass::code,
                                                                    FaultClass::statistics});

}  // namespace slamscope::slam
