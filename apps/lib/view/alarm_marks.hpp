// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "apps/lib/audit_watch.hpp"

namespace slamscope::apps {

/// What of a picture the audit flags, by feature and by pair. Made without arguments: nothing.
class AlarmMarks {
 public:
  using Pair = std::pair<slam::FeatureId, slam::FeatureId>;

  struct Mark {
    std::optional<Eigen::Matrix2d> last_good;  ///< P_ii or P_d (m²), where known
  };

  AlarmMarks() = default;
  explicit AlarmMarks(const Judgement& judgement);

  /// Null where it is not flagged.
  [[nodiscard]] const Mark* feature(slam::FeatureId id) const;
  /// In any order of the two. Null where the pair is not flagged.
  [[nodiscard]] const Mark* pair(slam::FeatureId a, slam::FeatureId b) const;
  /// For slam::PairMode::alarms.
  [[nodiscard]] std::span<const Pair> pairs() const { return pairs_; }
  /// Features all of whose pairs are flagged: pairs() are theirs.
  [[nodiscard]] std::span<const slam::FeatureId> blamed() const { return blamed_; }
  [[nodiscard]] bool empty() const { return features_.empty(); }

 private:
  std::map<slam::FeatureId, Mark> features_;
  std::vector<Pair> pairs_;  ///< sorted, smaller id first
  std::vector<Mark> pair_marks_;
  std::vector<slam::FeatureId> blamed_;
};

}  // namespace slamscope::apps
