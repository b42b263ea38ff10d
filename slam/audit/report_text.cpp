// SPDX-License-Identifier: MIT
#include "slam/audit/report_text.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "slam/audit/report_findings.hpp"

namespace slamscope::slam {
namespace {

constexpr std::size_t kLabel = 18;
constexpr std::size_t kWidth = 100;

/// A label and its text, wrapped under itself.
void line(std::string& out, std::string_view label, std::string_view text) {
  std::string head(label);
  head.resize(std::max(head.size() + 1, kLabel), ' ');
  std::size_t used = head.size();
  out += head;
  bool first = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!first && used + 1 + word.size() > kWidth) {
      out += '\n';
      out.append(kLabel, ' ');
      used = kLabel;
    } else if (!first) {
      out += ' ';
      ++used;
    }
    out += word;
    used += word.size();
    first = false;
  }
  out += '\n';
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string titleOf(FaultClass fault_class) {
  switch (fault_class) {
    case FaultClass::code:
      return "CODE FAULT";
    case FaultClass::statistics:
      return "STATISTICS";
    default:
      return "LINEARISATION";
  }
}

std::string blamed(const LawReport& law) {
  std::vector<std::string> words;
  for (const Blame& b : law.blame) {
    if (words.size() == 8) {
      words.emplace_back("and " + std::to_string(law.blame.size() - 8) + " more");
      break;
    }
    char share[20];
    std::snprintf(share, sizeof share, " (%.0f %%)", 100.0 * b.share);
    words.push_back(std::to_string(b.feature) + (law.blame.size() > 1 ? share : ""));
  }
  return joined(words);
}

void paragraph(std::string& out, const Finding& group) {
  const LawReport& first = *group[0];
  std::vector<std::string> names;
  for (const LawReport* law : group) names.emplace_back(lawName(law->law));
  std::string head = joined(names);
  if (first.first_time_s && first.first_record) {
    head += "   from t = " + timeText(*first.first_time_s) + ", record " +
            std::to_string(*first.first_record);
  }
  if (first.fault_class == FaultClass::code) {
    head += ", in " + std::to_string(first.violations) + " of " + std::to_string(first.checked) +
            " records";
  }
  line(out, titleOf(*first.fault_class), head);
  if (!first.blame.empty())
    line(out, first.blame.size() == 1 ? "feature" : "features", blamed(first));
  std::vector<std::string> said;
  for (const LawReport* law : group) {
    if (law->amount.empty() || std::find(said.begin(), said.end(), law->amount) != said.end()) {
      continue;
    }
    said.push_back(law->amount);
    line(out, "", law->amount);
  }
  std::size_t shown = 0;
  for (const LawReport* law : group) {
    for (const Evidence& e : law->evidence) {
      if (++shown > 6) return;
      line(out, e.what, "yours " + givenText(e) + ", lawful " + lawfulText(e));
    }
  }
}

}  // namespace

std::string reportText(const AuditReport& report) {
  std::string out;
  line(out, "audit", std::string(verdictWords(report)) + ": " + runWords(report));
  if (const std::string missing = missingWords(report); !missing.empty()) line(out, "", missing);
  for (const auto& group : findingsOf(report)) paragraph(out, group);
  for (const std::string& likely : report.likely) line(out, "likely", likely);
  for (const std::string& hint : report.hints) line(out, "perhaps meant", hint);
  std::vector<std::string> whole;
  std::map<std::string, std::vector<std::string>> unchecked;
  for (const LawReport& law : report.laws) {
    if (law.status == LawStatus::ok) whole.emplace_back(lawName(law.law));
    if (law.status == LawStatus::not_checkable) {
      unchecked[law.reason].emplace_back(lawName(law.law));
    }
  }
  if (!whole.empty()) line(out, "ok", joined(whole));
  for (const auto& [reason, names] : unchecked) {
    line(out, "not checked", joined(names) + (reason.empty() ? "" : " (" + reason + ")"));
  }
  if (!report.next_level.empty()) {
    out += "To have more checked, log besides:\n";
    for (const std::string& next : report.next_level) out += "    " + next + '\n';
  }
  return out;
}

}  // namespace slamscope::slam
