// SPDX-License-Identifier: MIT
// From what was counted to the report: classes, reasons, likely mistakes, what to log besides.
#include <algorithm>
#include <cmath>

#include "slam/audit/audit_state.hpp"
#include "slam/audit/law_nees.hpp"

namespace slamscope::slam {
namespace {

FaultClass classOf(Law law) {
  switch (law) {
    case Law::nis:
    case Law::nis_given:
    case Law::whiteness:
      return FaultClass::statistics;
    case Law::heading_floor:
    case Law::nees:
      return FaultClass::linearisation;
    default:
      return FaultClass::code;
  }
}

std::string missing(Law law, bool every_event, bool diagonal_only) {
  switch (law) {
    case Law::symmetric:
      return "only a triangle of P was written";
    case Law::support:
    case Law::range:
    case Law::map_still:
    case Law::motion:
    case Law::process_noise:
    case Law::initialise:
      return every_event ? "no such record" : "needs a record of every event (level L2)";
    case Law::rank:
      return every_event ? "no update" : "needs `observed`, or a record of every event (level L2)";
    case Law::nis:
      return diagonal_only ? "needs all of P (level L1)" : "no update could be measured";
    case Law::sensor_noise:
      return every_event ? "declare R in the header" : "needs R declared and level L2";
    case Law::whiteness:
    case Law::nis_given:
      return "needs innovations and S (level L3)";
    case Law::jacobian_given:
      return "needs H of the observations (level L3)";
    case Law::nees:
      return "no truth";
    default:
      return "nothing to look at";
  }
}

/// Calls of apps/loggers/slamscope_log.*, the same in the three languages.
std::vector<std::string> linesToL2() {
  return {
      R"(from slamscope_log import Log; record = Log("run.jsonl")   # Python)",
      R"(record = slamscope_log('run.jsonl');                       % MATLAB, Octave)",
      R"(slamscope::Log record("run.jsonl");                        // C++)",
      R"(record.predicted(x, P, t)         after every prediction)",
      R"(record.updated(x, P, [ids])       after every update: the features observed in it)",
      R"(record.initialised(x, P, [ids])   after every new feature (lists in C++: {ids}))",
      R"(The logger is one file to copy beside your filter: apps/loggers/slamscope_log.py, .m, .hpp)",
  };
}

std::vector<std::string> linesToL3(const RunHeader& header) {
  std::vector<std::string> lines;
  if (!header.R || header.sensor == Sensor::unknown) {
    lines.emplace_back(
        "record = Log(\"run.jsonl\", sensor=\"range-bearing\", R=R)   # or \"relative-position\"");
  }
  lines.emplace_back(
      "record.updated(x, P, [id], observations=[{\"id\": id, \"z\": z, \"innovation\": nu, \"S\": "
      "S, "
      "\"R\": R, \"H\": H}])");
  return lines;
}

void broken(LawReport& report, FaultClass fault_class) {
  report.status = LawStatus::violated;
  report.fault_class = fault_class;
}

}  // namespace

AuditReport Audit::State::report() const {
  AuditReport report;
  report.records = records;
  report.updates = updates;
  report.corrections_checked = corrections_checked;
  report.first_time_s = first_time_s;
  report.last_time_s = last_time_s;
  report.alpha = options.alpha;
  report.precision = covariance_precision.name();
  report.level = !options.means_known ? "LC"
                 : diagonal_only      ? "L0"
                 : !every_event       ? "L1"
                 : innovations        ? "L3"
                                      : "L2";
  if (truth) report.level += "+L4";

  LawTallies all = tallies;  // with what can only be said at the end
  const auto at = [&](Law law) -> LawTally& { return all[static_cast<std::size_t>(law)]; };
  if (last && last_finite) {
    at(Law::positive)
        .take(PositiveLaw::checkAll(*last, recordNoise(*last)), last->sequence, last_time_s);
    if (options.means_known) {
      at(Law::nees).take(checkNees(*last, options.alpha / 4.0), last->sequence, last_time_s);
    }
  }
  const auto take_nis = [&](Law law, const NisLaw& from) {
    if (from.count() == 0) return;
    const auto first = from.firstBroken();
    at(law).take(from.outcome(), first ? first->record : 0, first ? first->time_s : 0.0);
  };
  take_nis(Law::nis, nis);
  take_nis(Law::nis_given, nis_given);
  if (whiteness.count() > 0) {
    at(Law::whiteness)
        .take(whiteness.outcome(), whiteness.firstRecord().value_or(0), whiteness.firstTime());
  }

  for (int k = 0; k < kLawCount; ++k) {
    const Law law = static_cast<Law>(k);
    LawReport one = at(law).report(law);
    if (law == Law::nis) one.checked = nis.count();
    if (law == Law::nis_given) one.checked = nis_given.count();
    if (law == Law::whiteness) one.checked = whiteness.count();
    if (one.status == LawStatus::violated) one.fault_class = classOf(law);
    if (one.status == LawStatus::not_checkable && one.reason.empty()) {
      one.reason = missing(law, every_event, diagonal_only);
    }
    if (law == Law::process_noise && one.status == LawStatus::ok && unrotated.found()) {
      broken(one, FaultClass::statistics);
      one.violations = 1;
      one.first_record = last->sequence;
      one.first_time_s = last_time_s;
      one.amount = "the process noise keeps its direction in the map while the robot turns";
      report.likely.emplace_back(
          "the process noise is not rotated from the robot's frame into the map's");
    }
    if (one.fault_class) report.classes.insert(*one.fault_class);
    report.laws.push_back(std::move(one));
  }
  // Inconsistency speaks of linearisation only where the code is whole; errors that the innovations
  // show too are not the linearisation's.
  const bool heading = at(Law::heading_floor).violations() > 0;
  if (report.found(FaultClass::code) || (report.found(FaultClass::statistics) && !heading)) {
    report.classes.erase(FaultClass::linearisation);
    for (LawReport& law : report.laws) {
      if (law.fault_class != FaultClass::linearisation) continue;
      law.fault_class = report.found(FaultClass::code) ? FaultClass::code : FaultClass::statistics;
    }
  }
  for (const Signature* signature : fitting(all)) report.likely.emplace_back(signature->likely);

  for (const auto& [word, count] : allow_hints) {
    report.hints.push_back("--allow " + std::string(word) + " fits " + std::to_string(count) +
                           " records");
  }
  const auto pattern = [&](Law law, std::string_view name) { return at(law).share(name) > 0.5; };
  if (pattern(Law::map_still, "inflation"))
    report.hints.emplace_back("--allow inflation, if meant");
  if (pattern(Law::map_still, "noise-on-map")) {
    report.hints.emplace_back("--allow moving-features, if meant");
  }
  if (pattern(Law::map_still, "robocentric")) {
    report.hints.emplace_back("--allow robocentric, if meant");
  }
  if (at(Law::heading_floor).violations() > 0) {
    report.hints.emplace_back(
        "--allow absolute-sensor, if the filter has a compass or another absolute sensor");
  }
  if (!every_event) report.next_level = linesToL2();
  if (every_event && !innovations) report.next_level = linesToL3(header);

  report.verdict = !report.classes.empty()                     ? Verdict::violation
                   : corrections_checked >= kFewestCorrections ? Verdict::ok
                                                               : Verdict::inconclusive;
  return report;
}

}  // namespace slamscope::slam
