// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "slam/audit/audit_report.hpp"

namespace slamscope::slam {

/// What one law says of one record or transition.
struct Outcome {
  enum class Kind { not_applicable, not_checkable, checked };

  Kind kind = Kind::not_applicable;
  double residual = 0.0;   ///< scaled, without unit
  double tolerance = 0.0;  ///< violated where residual > tolerance or not a number
  std::vector<Blame> blame;
  std::vector<Evidence> evidence;
  std::string amount;  ///< the violation in words
  std::string reason;  ///< where not checkable
  /// Names of known ways to break the law that fit this record (signatures.hpp).
  std::vector<std::string_view> patterns;

  [[nodiscard]] bool checked() const { return kind == Kind::checked; }
  [[nodiscard]] bool violated() const { return checked() && !(residual <= tolerance); }

  /// Adds evidence: the number found beside the one that the law demands.
  void show(std::string_view what, double given, double lawful,
            LawfulIs lawful_is = LawfulIs::exactly);

  [[nodiscard]] static Outcome of(double residual, double tolerance) {
    Outcome outcome;
    outcome.kind = Kind::checked;
    outcome.residual = residual;
    outcome.tolerance = tolerance;
    return outcome;
  }
  [[nodiscard]] static Outcome notCheckable(std::string reason) {
    Outcome outcome;
    outcome.kind = Kind::not_checkable;
    outcome.reason = std::move(reason);
    return outcome;
  }
};

}  // namespace slamscope::slam
