// SPDX-License-Identifier: MIT
#include "slam/audit/report_html.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "slam/audit/report_text.hpp"
#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

using Json = nlohmann::json;

struct Audited {
  AuditReport report;
  ReportSeries series;
};

Audited audited(const SimulationOptions& options,
                const std::function<void(Snapshot&)>& spoil = {}) {
  Simulation simulation(options);
  Audit audit({}, simulation.header());
  Audited result;
  const Subscription subscription =
      simulation.filter().observe(kRecordAll, [&](const SnapshotPtr& snapshot) {
        auto record = std::make_shared<Snapshot>(*snapshot);
        if (spoil) spoil(*record);
        audit.take(record);
        result.series.take(record, audit.lastRecord());
      });
  while (simulation.step()) {
  }
  result.report = audit.report();
  return result;
}

Audited faultyRun() {
  SimulationOptions options = oneLoop(1);
  options.fault = "paper";
  options.fault_features = {8};
  return audited(options);
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

Json embedded(const std::string& page, const std::string& id) {
  const std::string open = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t begin = page.find(open);
  if (begin == page.npos) return {};
  const std::size_t end = page.find("</script>", begin);
  return Json::parse(page.substr(begin + open.size(), end - begin - open.size()));
}

/// What the page would fetch: the value of src, of href unless inside the page, of url(…), @import.
std::vector<std::string> fetched(const std::string& page) {
  static const std::regex kReference(
      R"re(\bsrc\s*=\s*["'](?!data:)|\bhref\s*=\s*["'](?!#|data:)|url\((?!#|\$)|@import|\bfetch\(|XMLHttpRequest)re");
  return {std::sregex_token_iterator(page.begin(), page.end(), kReference), {}};
}

std::vector<double> decoded(const Json& data, const std::string& text) {
  const auto digit = [](char c) -> unsigned {
    if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a') + 26U;
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0') + 52U;
    return c == '+' ? 62U : 63U;
  };
  std::vector<unsigned> bytes;
  for (std::size_t k = 0; k + 3 < text.size(); k += 4) {
    unsigned group = 0;
    unsigned padding = 0;
    for (std::size_t d = 0; d < 4; ++d) {
      const char c = text[k + d];
      group = (group << 6U) | (c == '=' ? 0U : digit(c));
      if (c == '=') ++padding;
    }
    for (unsigned b = 0; b < 3 - padding; ++b) bytes.push_back((group >> (16U - 8U * b)) & 255U);
  }
  std::vector<double> sizes;
  const double lo = data["range"][0], hi = data["range"][1];
  for (std::size_t k = 0; k + 1 < bytes.size(); k += 2) {
    const unsigned code = bytes[k] + 256U * bytes[k + 1];
    sizes.push_back(code < 4 ? -1.0 * code : std::pow(10.0, lo + (code - 4) / 65531.0 * (hi - lo)));
  }
  return sizes;
}

TEST(AuditPage, SaysWhatTheTextSays) {
  const Audited run = faultyRun();
  const std::string page = reportHtml(run.report, run.series, "run.jsonl");
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_EQ(count(page, "<h1>Laws are broken: code fault</h1>"), 1U);
  EXPECT_EQ(count(page, "<article class=\"finding code\">"), 1U);
  EXPECT_EQ(count(page, "href=\"#record=" +
                            std::to_string(*run.report.law(Law::shrink).first_record) + "\""),
            4U);  // in the verdict, and in the table for each of three laws
  EXPECT_NE(page.find("<b>8</b>"), page.npos);
  EXPECT_NE(page.find("yours</th>"), page.npos);
  EXPECT_NE(page.find(run.report.likely.at(0)), page.npos);
  EXPECT_NE(page.find(run.report.law(Law::shrink).amount), page.npos);
  EXPECT_EQ(count(page, "{{"), 0U);
}

TEST(AuditPage, OfAHealthyRunSaysSo) {
  const Audited run = audited(oneLoop(1));
  const std::string page = reportHtml(run.report, run.series, "run.jsonl");
  EXPECT_EQ(count(page, "<h1>No law is broken</h1>"), 1U);
  EXPECT_EQ(count(page, "<article"), 0U);
}

TEST(AuditPage, FetchesNothing) {
  const Audited run = faultyRun();
  const std::string page = reportHtml(run.report, run.series, "run.jsonl");
  EXPECT_TRUE(fetched(page).empty()) << fetched(page).front();
  for (const char* bad : {"<script src='x.js'>", "<a href=\"https://a.b\">", "url(font.woff)",
                          "@import 'x'", "fetch('x')"}) {
    EXPECT_FALSE(fetched(bad).empty()) << bad;
  }
}

TEST(AuditPage, NamesCannotLeaveTheirPlace) {
  const Audited run = audited(oneLoop(1));
  const std::string name = "a\"b'<c>&</script><script>alert(1)</script>{{data}}\xff";
  const std::string page = reportHtml(run.report, run.series, name);
  EXPECT_EQ(count(page, "<script"), 3U);
  EXPECT_EQ(count(page, "</script"), 3U);
  EXPECT_EQ(count(page, "<c>"), 0U);
  EXPECT_NE(page.find("<code>a&quot;b&#39;&lt;c&gt;&amp;&lt;/script&gt;"), page.npos);
  const Json data = embedded(page, "data");
  EXPECT_TRUE(data["run"].get<std::string>().starts_with(
      "a\"b'<c>&</script><script>alert(1)</script>{{data}}"));
}

TEST(AuditPage, HoldsTheReportForPrograms) {
  const Audited run = faultyRun();
  const Json report = embedded(reportHtml(run.report, run.series, "run"), "report");
  EXPECT_EQ(report["verdict"], "violation");
  EXPECT_EQ(report["laws"].size(), static_cast<std::size_t>(kLawCount));
}

TEST(AuditPage, DataAreTheSeriesToAThousandth) {
  const Audited run = faultyRun();
  const std::vector<SeriesRecord> records = run.series.records();
  const Json data = embedded(reportHtml(run.report, run.series, "run"), "data");
  ASSERT_EQ(data["kept"].size(), records.size());
  EXPECT_EQ(data["blamed"].size(), 1U);
  EXPECT_EQ(data["blamed"][0]["id"], 8);
  for (std::size_t k = 0; k < records.size(); k += 50) {
    const std::vector<double> sizes = decoded(data, data["kept"][k]["m"]);
    ASSERT_EQ(sizes.size(), records[k].sizes.size());
    for (std::size_t c = 0; c < sizes.size(); ++c) {
      EXPECT_NEAR(sizes[c], records[k].sizes[c], 1e-3 * records[k].sizes[c]);
    }
  }
}

TEST(AuditPage, OfARunThatBecomesNotANumberIsWhole) {
  const Audited run = audited(oneLoop(1), [](Snapshot& s) {
    if (s.sequence < 200) return;
    s.pose[0] = std::nan("");
    s.covariance(2, 2) = std::numeric_limits<double>::infinity();
    s.covariance(3, 3) = std::nan("");
    s.covariance(5, 5) = -1.0;
  });
  const Json data = embedded(reportHtml(run.report, run.series, "run"), "data");
  const Json& last = data["kept"].back();
  EXPECT_TRUE(last["p"][0].is_null());
  EXPECT_TRUE(last["v"][2].is_null());
  const std::vector<double> sizes = decoded(data, last["m"]);
  EXPECT_EQ(sizes[0], -1.0);  // not finite
  EXPECT_EQ(sizes[2], -2.0);  // not positive
}

TEST(AuditPage, OfNothingIsAPage) {
  const Audit audit;
  const std::string page = reportHtml(audit.report(), ReportSeries{}, "run");
  EXPECT_EQ(count(page, "<h1>Too little to judge</h1>"), 1U);
  EXPECT_TRUE(embedded(page, "data")["kept"].empty());
}

TEST(AuditPage, StaysSmallHoweverLongTheRunAndLargeTheMap) {
  ReportSeries series;
  auto map = std::make_shared<Snapshot>();
  constexpr int kFeatures = 300;
  map->covariance = PackedCovariance(3 + 2 * kFeatures);
  for (int row = 0; row < map->covariance.size(); ++row) {
    map->covariance(row, row) = 1e-3 * (1 + row % 17);
  }
  for (int i = 0; i < kFeatures; ++i) {
    map->ids.push_back(static_cast<FeatureId>(i + 1));
    map->features.emplace_back(0.1 * i, 0.0);
  }
  for (std::uint64_t k = 1; k <= 1500; ++k) {
    auto s = std::make_shared<Snapshot>(*map);
    s->sequence = k;
    RecordFindings findings;
    findings.judged = k;
    series.take(s, findings);
  }
  EXPECT_LT(reportHtml(Audit().report(), series, "run").size(), 4'000'000U);
}

}  // namespace
}  // namespace slamscope::slam
