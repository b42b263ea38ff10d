// SPDX-License-Identifier: MIT
#include "apps/lib/view/alarm_lines.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace slamscope::apps {
namespace {

constexpr std::size_t kMostLaws = 3;
constexpr std::size_t kMostFeatures = 8;
constexpr std::size_t kMostLetters = 100;  // of an amount
constexpr std::chrono::nanoseconds kLate = std::chrono::milliseconds(200);

std::string evidence(slam::FaultClass fault_class) {
  switch (fault_class) {
    case slam::FaultClass::code:
      return "CODE FAULT";
    case slam::FaultClass::statistics:
      return "STATISTICS";
    case slam::FaultClass::linearisation:
      break;
  }
  return "linearisation";
}

std::string features(const slam::LawReport& law) {
  if (law.blame.empty()) return {};
  std::vector<slam::FeatureId> ids;
  for (const slam::Blame& blame : law.blame) ids.push_back(blame.feature);
  const std::size_t left = ids.size() - std::min(ids.size(), kMostFeatures);
  ids.resize(ids.size() - left);  // those with the largest shares
  std::sort(ids.begin(), ids.end());
  std::string text = law.blame.size() == 1 ? " · feature" : " · features";
  for (std::size_t k = 0; k < ids.size(); ++k) {
    text += (k == 0 ? " " : ", ") + std::to_string(ids[k]);
  }
  if (left > 0) text += " and " + std::to_string(left) + " more";
  return text;
}

std::string shortened(const std::string& text) {
  if (text.size() <= kMostLetters) return text;
  return text.substr(0, text.rfind(' ', kMostLetters)) + " …";
}

AlarmLine headline(const slam::LawReport& law) {
  char when[80];
  std::snprintf(when, sizeof when, " · from t %.2f s, record %llu", law.first_time_s.value_or(0.0),
                static_cast<unsigned long long>(law.first_record.value_or(0)));
  return AlarmLine(evidence(*law.fault_class) + ": " + std::string(slam::lawName(law.law)) + when +
                       features(law),
                   law.fault_class != slam::FaultClass::linearisation);
}

std::string wholeLine(const Judgement& judgement) {
  if (judgement.records == 0) return "audit: nothing judged yet";
  return "audit: no law is broken in " + std::to_string(judgement.records) + " records";
}

}  // namespace

std::vector<AlarmLine> alarmLines(const Judgement& judgement, std::chrono::nanoseconds shown,
                                  bool also_whole) {
  std::vector<AlarmLine> lines;
  std::string others;
  for (const slam::LawReport& law : judgement.broken) {
    if (lines.size() >= 2 * kMostLaws) {
      others += (others.empty() ? "also broken: " : ", ") + std::string(slam::lawName(law.law));
      continue;
    }
    lines.push_back(headline(law));
    lines.emplace_back("    " + shortened(law.amount), lines.back().alarm);
  }
  if (!others.empty()) lines.emplace_back(others, true);
  if (lines.empty() && also_whole) lines.emplace_back(wholeLine(judgement));
  if (judgement.records > 0 && shown - judgement.time > kLate) {
    char text[64];
    std::snprintf(text, sizeof text, "the audit is %.1f s behind",
                  std::chrono::duration<double>(shown - judgement.time).count());
    lines.emplace_back(text);
  }
  return lines;
}

}  // namespace slamscope::apps
