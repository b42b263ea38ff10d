// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "slam/audit/audit.hpp"
#include "slam/audit/law_heading_floor.hpp"
#include "slam/audit/law_nis.hpp"
#include "slam/audit/law_positive.hpp"
#include "slam/audit/law_process_noise.hpp"
#include "slam/audit/law_support.hpp"
#include "slam/audit/law_tally.hpp"
#include "slam/audit/law_whiteness.hpp"
#include "slam/audit/lawful_update.hpp"
#include "slam/audit/linearisation.hpp"
#include "slam/audit/log_precision.hpp"
#include "slam/audit/signatures.hpp"
#include "slam/audit/transition.hpp"
#include "slam/audit/update_sweep.hpp"

namespace slamscope::slam {

/// All that the audit remembers between records.
struct Audit::State {
  State(AuditOptions options_in, RunHeader header_in);

  AuditOptions options;
  RunHeader header;

  LawTallies tallies;
  PositiveLaw positive;
  HeadingFloorLaw heading_floor;
  UnrotatedNoise unrotated;
  NisLaw nis;
  NisLaw nis_given;
  WhitenessLaw whiteness;
  LinearisationPoints points;
  LogPrecision covariance_precision;
  LogPrecision mean_precision;
  double arithmetic = 1e-11;  ///< error of the filter's own arithmetic, as far as seen

  SnapshotPtr last;
  bool last_finite = true;
  std::uint64_t records = 0;
  std::uint64_t updates = 0;
  std::uint64_t corrections_checked = 0;
  double first_time_s = 0.0;
  double last_time_s = 0.0;
  bool every_event = false;  ///< L2: some record is a prediction, an update or an initialisation
  bool diagonal_only = false;
  bool observed_given = false;
  bool extra = false;
  bool truth = false;
  bool innovations = false;
  std::map<std::string_view, std::uint64_t> allow_hints;  ///< words and how many records they fit

  struct Blamed {
    FeatureAlarm alarm;
    std::uint64_t last_update = 0;  ///< `updates` when it was blamed last
    SnapshotPtr last_good;          ///< the record before it was blamed first
  };
  std::map<FeatureId, Blamed> blamed;
  [[nodiscard]] bool isActive(const Blamed& b) const { return updates <= b.last_update + 1; }

  RecordFindings newest;

  // Of the record that is judged now:
  bool checked = false;  ///< some law could be
  bool swept = false;    ///< it is an update of the whole state, and `sweep` has gone over it
  UpdateSweep sweep;
  LawfulUpdate lawful;

  void take(const SnapshotPtr& snapshot);
  /// The transition to this record, if it is one; looks at it where it is an update.
  [[nodiscard]] std::optional<Transition> lookAt(const SnapshotPtr& snapshot);
  void count(const Snapshot& snapshot);
  /// False where the record is not finite.
  bool judgeRecord(const Snapshot& snapshot);
  void judgePositive(const Snapshot& snapshot, double noise);
  void judgeInnovationsGiven(const Snapshot& snapshot);
  void judgeTransition(const Transition& t);
  void judgePrediction(const Transition& t);
  void judgeUpdate(const Transition& t);
  void judgeLawfulUpdate(const Transition& t);
  void judgeSensorNoise(const Transition& t, const UpdateAnatomy& anatomy,
                        const InnovationEstimate& estimate);
  void judgeInitialisation(const Transition& t);
  void judgeStep(const Transition& t);
  void judgeShrink(const Transition& t, bool map_only, bool everything);

  /// Whether mean and covariance are in the log, both and whole.
  [[nodiscard]] bool comparable() const { return !diagonal_only && options.means_known; }
  [[nodiscard]] bool repeatsLast(const Snapshot& snapshot) const;
  [[nodiscard]] bool allows(Allow allow) const { return options.allow.contains(allow); }
  [[nodiscard]] Exactness exactness() const;
  /// Error of an entry of P of this record, scaled by √diag.
  [[nodiscard]] double recordNoise(const Snapshot& snapshot) const;
  void note(Law law, const Outcome& outcome, const Snapshot& snapshot);
  void noteInnovation(const InnovationEstimate& estimate, const Snapshot& snapshot);
  void hint(const std::optional<std::string_view>& allow);
  [[nodiscard]] AuditReport report() const;
};

/// A law that is not looked at because of --allow.
[[nodiscard]] Outcome declaredAway(Allow allow);

}  // namespace slamscope::slam
