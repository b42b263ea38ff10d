// SPDX-License-Identifier: MIT
#include "slam/audit/report_html.hpp"

#include <cstdio>
#include <initializer_list>
#include <utility>

#include "slam/audit/law_words.hpp"
#include "slam/audit/page_parts.hpp"
#include "slam/audit/report_findings.hpp"
#include "slam/audit/report_json.hpp"
#include "slam/audit/report_page_data.hpp"
#include "slam/audit/report_text.hpp"

namespace slamscope::slam {
namespace {

std::string escapedHtml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

/// JSON inside <script>: `<` stands in strings only, and must not end the script there.
std::string inScript(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";
    } else {
      out += c;
    }
  }
  return out;
}

/// <name attributes>text</name>, the text escaped.
std::string tagged(std::string_view name, std::string_view attributes, std::string_view text) {
  std::string out("<");
  out.append(name);
  if (!attributes.empty()) out.append(" ").append(attributes);
  return out.append(">").append(escapedHtml(text)).append("</").append(name).append(">");
}

std::string recordLink(const LawReport& law) {
  if (!law.first_record) return {};
  const std::string record = std::to_string(*law.first_record);
  return tagged("a", "href=\"#record=" + record + "\"", "record " + record);
}

std::string classTitle(FaultClass fault_class) {
  switch (fault_class) {
    case FaultClass::code:
      return "Code fault";
    case FaultClass::statistics:
      return "Statistics";
    default:
      return "Linearisation";
  }
}

/// "Laws are broken: code fault, statistics"
std::string headline(const AuditReport& report) {
  std::string text(verdictWords(report));
  text[0] = static_cast<char>(text[0] - 'a' + 'A');
  for (const FaultClass c : report.classes) {
    std::string title = classTitle(c);
    title[0] = static_cast<char>(title[0] - 'A' + 'a');
    text.append(c == *report.classes.begin() ? ": " : ", ").append(title);
  }
  return text;
}

/// Class of the style sheet: the gravest that was found.
std::string gravity(const AuditReport& report) {
  if (!report.classes.empty()) return std::string(faultClassName(*report.classes.begin()));
  return std::string(verdictName(report.verdict));
}

std::string blameHtml(const LawReport& law) {
  std::string out = "<p class=\"blame\"><span class=\"label\">";
  out += law.blame.size() == 1 ? "feature" : "features";
  out += "</span>";
  constexpr std::size_t kMost = 12;
  for (std::size_t k = 0; k < law.blame.size() && k < kMost; ++k) {
    char share[40];
    std::snprintf(share, sizeof share, "%.0f %%", 100.0 * law.blame[k].share);
    out.append(" <span class=\"feature\">")
        .append(tagged("b", "", std::to_string(law.blame[k].feature)));
    if (law.blame.size() > 1) out.append(" ").append(tagged("small", "", share));
    out += "</span>";
  }
  if (law.blame.size() > kMost) {
    const std::string left_out = std::to_string(law.blame.size() - kMost);
    out.append(" ").append(tagged("small", "", "and " + left_out + " more"));
  }
  return out + "</p>\n";
}

std::string evidenceHtml(const Finding& finding) {
  std::string rows;
  for (const LawReport* law : finding) {
    for (const Evidence& e : law->evidence) {
      rows.append("<tr>").append(tagged("th", "scope=\"row\"", e.what));
      rows += tagged("td", "", givenText(e)) + tagged("td", "", lawfulText(e)) + "</tr>\n";
    }
  }
  if (rows.empty()) return {};
  return "<table class=\"evidence\"><thead><tr><th scope=\"col\">worst record</th>"
         "<th scope=\"col\">yours</th><th scope=\"col\">lawful</th></tr></thead><tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string findingHtml(const Finding& finding) {
  const LawReport& first = *finding[0];
  std::string out("<article class=\"finding ");
  out.append(faultClassName(*first.fault_class)).append("\">\n<h2>");
  out += escapedHtml(classTitle(*first.fault_class));
  for (const LawReport* law : finding) {
    const std::string title = "title=\"" + escapedHtml(lawWords(law->law)) + "\"";
    out.append(" ").append(tagged("code", title, lawName(law->law)));
  }
  out += "</h2>\n<p class=\"when\">";
  if (first.first_time_s) {
    out.append("from t = ").append(timeText(*first.first_time_s)).append(", ");
  }
  out += recordLink(first);
  if (first.fault_class == FaultClass::code) {
    out.append(", in ").append(std::to_string(first.violations)).append(" of ");
    out.append(std::to_string(first.checked)).append(" records");
  }
  out += "</p>\n";
  if (!first.blame.empty()) out += blameHtml(first);
  std::string said;
  for (const LawReport* law : finding) {
    if (law->amount.empty() || law->amount == said) continue;
    said = law->amount;
    out += tagged("p", "", law->amount) + "\n";
  }
  return out + evidenceHtml(finding) + "</article>\n";
}

std::string verdictHtml(const AuditReport& report) {
  std::string out("<section class=\"verdict ");
  out.append(gravity(report)).append("\" id=\"verdict\">\n");
  out.append(tagged("h1", "", headline(report))).append("\n");
  out.append(tagged("p", "class=\"summary\"", runWords(report))).append("\n");
  if (const std::string missing = missingWords(report); !missing.empty()) {
    out.append(tagged("p", "class=\"summary\"", missing)).append("\n");
  }
  const auto list = [&](std::string_view label, const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      out.append("<p class=\"likely\">").append(tagged("span", "class=\"label\"", label));
      out.append(" ").append(escapedHtml(line)).append("</p>\n");
    }
  };
  list("likely", report.likely);
  list("perhaps meant", report.hints);
  out += "</section>\n";
  const std::vector<Finding> findings = findingsOf(report);
  if (findings.empty()) return out;
  out += "<section class=\"findings\">\n";
  for (const Finding& finding : findings) out += findingHtml(finding);
  return out + "</section>\n";
}

std::string timesText(std::uint64_t count) {
  return count == 1 ? "once" : std::to_string(count) + " times";
}

std::string lawRow(const LawReport& law) {
  const bool violated = law.status == LawStatus::violated;
  std::string status = violated ? "broken" : law.status == LawStatus::ok ? "ok" : "not checked";
  std::string detail;
  if (violated) detail.append("from ").append(recordLink(law)).append(", ");
  if (law.checked > 0) detail += "checked " + timesText(law.checked);
  if (law.status == LawStatus::not_checkable) detail = escapedHtml(law.reason);
  std::string out("<tr class=\"");
  out.append(lawStatusName(law.status)).append("\"><th scope=\"row\">");
  out.append(tagged("code", "", lawName(law.law))).append("</th>");
  out.append(tagged("td", "class=\"status\"", status));
  out.append(tagged("td", "", lawWords(law.law)));
  return out.append("<td>").append(detail).append("</td></tr>\n");
}

std::string lawsHtml(const AuditReport& report) {
  std::string out;
  for (const LawReport& law : report.laws) out += lawRow(law);
  return out;
}

/// Fills the {{slots}}; what is filled in is not looked at again.
std::string withSlots(std::string_view page,
                      std::initializer_list<std::pair<std::string_view, std::string>> slots) {
  std::string out;
  while (true) {
    const std::size_t open = page.find("{{");
    out += page.substr(0, open);
    if (open == page.npos) return out;
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    for (const auto& [slot, text] : slots) {
      if (slot == name) out += text;
    }
    page.remove_prefix(close + 2);
  }
}

}  // namespace

std::string reportHtml(const AuditReport& report, const ReportSeries& series,
                       std::string_view run_name) {
  return withSlots(pageDocument(), {{"run", escapedHtml(run_name)},
                                    {"headline", escapedHtml(headline(report))},
                                    {"style", std::string(pageStyle())},
                                    {"verdict", verdictHtml(report)},
                                    {"laws", lawsHtml(report)},
                                    {"text", escapedHtml(reportText(report))},
                                    {"report", inScript(reportJson(report))},
                                    {"data", inScript(pageData(report, series, run_name))},
                                    {"script", std::string(pageScript())}});
}

}  // namespace slamscope::slam
