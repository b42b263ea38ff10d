// SPDX-License-Identifier: MIT
#include "slam/audit/report_junit.hpp"

#include <algorithm>

#include "slam/audit/report_findings.hpp"

namespace slamscope::slam {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // XML 1.0 has no control characters but these.
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t') result += c;
    }
  }
  return result;
}

std::string detailsOf(const LawReport& law) {
  std::string text;
  if (law.first_record) {
    text += "from record " + std::to_string(*law.first_record) + ", " +
            std::to_string(law.violations) + " of " + std::to_string(law.checked) + " records\n";
  }
  for (const Blame& b : law.blame) {
    text += "feature " + std::to_string(b.feature) + ": share " + std::to_string(b.share) + '\n';
  }
  for (const Evidence& e : law.evidence) {
    text += e.what + ": yours " + givenText(e) + ", lawful " + lawfulText(e) + '\n';
  }
  return text;
}

std::string testCase(const LawReport& law, bool fails) {
  const std::string head =
      "  <testcase classname=\"slamscope.audit\" name=\"" + std::string(lawName(law.law)) + "\"";
  if (law.status == LawStatus::ok) return head + "/>\n";
  if (law.status == LawStatus::not_checkable) {
    return head + ">\n    <skipped message=\"" + escaped(law.reason) + "\"/>\n  </testcase>\n";
  }
  const std::string type(faultClassName(*law.fault_class));
  if (fails) {
    return head + ">\n    <failure type=\"" + type + "\" message=\"" + escaped(law.amount) + "\">" +
           escaped(detailsOf(law)) + "</failure>\n  </testcase>\n";
  }
  return head + ">\n    <system-out>" + escaped(type + ": " + law.amount + '\n' + detailsOf(law)) +
         "</system-out>\n  </testcase>\n";
}

}  // namespace

std::string reportJunit(const AuditReport& report, std::string_view run_name,
                        const std::set<FaultClass>& fail_on) {
  const auto fails = [&](const LawReport& law) {
    return law.status == LawStatus::violated && report.found(*law.fault_class) &&
           fail_on.contains(*law.fault_class);
  };
  const auto count = [&](auto predicate) {
    return std::to_string(std::count_if(report.laws.begin(), report.laws.end(), predicate));
  };
  const std::string missing = missingWords(report);
  const std::size_t inconclusive = missing.empty() ? 0 : 1;
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"" + escaped(run_name) +
      "\" tests=\"" + std::to_string(report.laws.size() + inconclusive) + "\" failures=\"" +
      count(fails) + "\" errors=\"" + std::to_string(inconclusive) + "\" skipped=\"" +
      count([](const LawReport& law) { return law.status == LawStatus::not_checkable; }) + "\">\n";
  if (inconclusive != 0) {
    xml += "  <testcase classname=\"slamscope.audit\" name=\"verdict\">\n    <error type=\"";
    xml.append(verdictName(report.verdict)).append("\" message=\"").append(escaped(missing));
    xml += "\"/>\n  </testcase>\n";
  }
  for (const LawReport& law : report.laws) xml += testCase(law, fails(law));
  return xml + "</testsuite>\n";
}

}  // namespace slamscope::slam
