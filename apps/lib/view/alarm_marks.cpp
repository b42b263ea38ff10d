// SPDX-License-Identifier: MIT
#include "apps/lib/view/alarm_marks.hpp"

#include <algorithm>

namespace slamscope::apps {

AlarmMarks::AlarmMarks(const Judgement& judgement) {
  for (const slam::FeatureId id : judgement.flagged()) features_[id] = {};
  for (const slam::FeatureAlarm& alarm : judgement.alarms.features) {
    if (!alarm.active) continue;
    features_[alarm.feature].last_good = alarm.last_good;
    blamed_.push_back(alarm.feature);
  }
  std::vector<slam::PairAlarm> alarms = judgement.alarms.pairs;
  std::sort(alarms.begin(), alarms.end(), [](const slam::PairAlarm& l, const slam::PairAlarm& r) {
    return Pair(l.a, l.b) < Pair(r.a, r.b);
  });
  pairs_.reserve(alarms.size());
  for (const slam::PairAlarm& alarm : alarms) {
    pairs_.emplace_back(alarm.a, alarm.b);
    pair_marks_.push_back({alarm.last_good});
  }
}

const AlarmMarks::Mark* AlarmMarks::feature(slam::FeatureId id) const {
  const auto found = features_.find(id);
  return found == features_.end() ? nullptr : &found->second;
}

const AlarmMarks::Mark* AlarmMarks::pair(slam::FeatureId a, slam::FeatureId b) const {
  const Pair wanted(std::min(a, b), std::max(a, b));
  const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), wanted);
  if (found == pairs_.end() || *found != wanted) return nullptr;
  return &pair_marks_[static_cast<std::size_t>(found - pairs_.begin())];
}

}  // namespace slamscope::apps
