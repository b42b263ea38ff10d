// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "slam/audit/outcome.hpp"

namespace slamscope::slam {

/// What one law said over the run: counts, the first and the worst violation, blame, patterns.
class LawTally {
 public:
  void take(const Outcome& outcome, std::uint64_t record, double time_s);

  [[nodiscard]] LawReport report(Law law) const;
  [[nodiscard]] std::uint64_t violations() const { return violations_; }
  [[nodiscard]] std::uint64_t checked() const { return checked_; }
  /// Share of the violations that the pattern fits.
  [[nodiscard]] double share(std::string_view pattern) const;

 private:
  std::uint64_t checked_ = 0;
  std::uint64_t violations_ = 0;
  std::uint64_t first_record_ = 0;
  double first_time_s_ = 0.0;
  double worst_excess_ = -1.0;  ///< residual over tolerance of the record kept in worst_
  Outcome worst_;
  double whole_residual_ = 0.0;  ///< largest of records that keep the law
  double whole_tolerance_ = 0.0;
  std::map<FeatureId, double> blame_;
  std::map<std::string_view, std::uint64_t> patterns_;
  std::string reason_;
};

}  // namespace slamscope::slam
