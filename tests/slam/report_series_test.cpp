// SPDX-License-Identifier: MIT
#include "slam/audit/report_series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/correlation.hpp"
#include "tests/slam/audit_runs.hpp"

namespace slamscope::slam {
namespace {

/// A map of n features in a row, each with its own variance (m²).
std::shared_ptr<Snapshot> rowOfFeatures(int n) {
  auto s = std::make_shared<Snapshot>();
  s->covariance = PackedCovariance(3 + 2 * n);
  for (int i = 0; i < n; ++i) {
    s->ids.push_back(static_cast<FeatureId>(i + 1));
    s->features.emplace_back(0.1 * i, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
      const int row = Snapshot::row(i) + axis;
      s->covariance(row, row) = 1e-3 * (1 + i);
    }
  }
  return s;
}

/// Takes `count` records of one map, each of them an update with NIS 2 over 2.
void takeMany(ReportSeries& series, int count, const std::map<int, RecordFindings>& special = {}) {
  const auto map = rowOfFeatures(3);
  for (int k = 0; k < count; ++k) {
    auto s = std::make_shared<Snapshot>(*map);
    s->sequence = static_cast<std::uint64_t>(k);
    const auto found = special.find(k);
    RecordFindings findings = found == special.end() ? RecordFindings{} : found->second;
    findings.judged = static_cast<std::uint64_t>(k) + 1;
    findings.nis = 2.0;
    findings.dof = 2;
    series.take(s, findings);
  }
}

std::vector<std::uint64_t> numbersOf(const std::vector<SeriesRecord>& records) {
  std::vector<std::uint64_t> numbers;
  for (const SeriesRecord& r : records) numbers.push_back(r.record);
  return numbers;
}

TEST(ReportSeries, KeepsAShortRunWhole) {
  ReportSeries series;
  takeMany(series, 100);
  EXPECT_EQ(series.records().size(), 100U);
}

TEST(ReportSeries, OfALongRunKeepsABoundedNumberEvenlyWithBothEnds) {
  ReportSeries series;
  takeMany(series, 20'003);
  const std::vector<std::uint64_t> numbers = numbersOf(series.records());
  EXPECT_LE(numbers.size(), ReportSeries::kMostRecords + 1);
  EXPECT_GT(numbers.size(), ReportSeries::kMostRecords / 2);
  EXPECT_EQ(numbers.front(), 0U);
  EXPECT_EQ(numbers.back(), 20'002U);
  for (std::size_t k = 2; k + 1 < numbers.size(); ++k) {
    EXPECT_EQ(numbers[k] - numbers[k - 1], numbers[1]) << k;
  }
}

TEST(ReportSeries, SumsOverWhatItDropped) {
  ReportSeries series;
  takeMany(series, 20'003);
  SeriesStretch all;
  for (const SeriesRecord& r : series.records()) all.add(r.stretch);
  EXPECT_EQ(all.records, 20'003U);
  EXPECT_EQ(all.dof, 2 * 20'003);
  EXPECT_DOUBLE_EQ(all.nis, 2.0 * 20'003);
}

TEST(ReportSeries, KeepsTheRecordWhereALawFirstBrokeAndTheOneBefore) {
  RecordFindings shrink;
  shrink.broken = {Law::shrink};
  shrink.features = {2};
  ReportSeries series;
  takeMany(series, 20'003, {{7'777, shrink}, {7'779, shrink}});
  const std::vector<SeriesRecord> records = series.records();
  const std::vector<std::uint64_t> numbers = numbersOf(records);
  const auto broken = std::find(numbers.begin(), numbers.end(), 7'777U);
  ASSERT_NE(broken, numbers.end());
  EXPECT_EQ(*(broken - 1), 7'776U);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 7'779U), 0);
  const SeriesRecord& kept = records[static_cast<std::size_t>(broken - numbers.begin())];
  EXPECT_TRUE(kept.stretch.broken[static_cast<std::size_t>(Law::shrink)]);
  EXPECT_EQ(kept.stretch.blamed, std::vector<FeatureId>{2});
  EXPECT_EQ(kept.stretch.records, 1U);
  // The second time is in the sum of a later one.
  const SeriesRecord& next = records[static_cast<std::size_t>(broken - numbers.begin()) + 1];
  EXPECT_TRUE(next.stretch.broken[static_cast<std::size_t>(Law::shrink)]);
}

TEST(ReportSeries, EveryLawBreakingAnewIsStillBounded) {
  std::map<int, RecordFindings> special;
  for (int k = 0; k < kLawCount; ++k) special[1'001 * (k + 1)].broken = {static_cast<Law>(k)};
  ReportSeries series;
  takeMany(series, 20'003, special);
  const std::vector<std::uint64_t> numbers = numbersOf(series.records());
  EXPECT_LE(numbers.size(), ReportSeries::kMostRecords + 2 * kLawCount + 1);
  for (const auto& [k, findings] : special) {
    EXPECT_TRUE(std::count(numbers.begin(), numbers.end(), static_cast<std::uint64_t>(k))) << k;
  }
}

TEST(ReportSeries, SizesAreRootsOfDeterminantsOfRelativeCovariances) {
  Simulation simulation(oneLoop(1));
  Audit audit;
  ReportSeries series;
  SnapshotPtr last;
  const Subscription subscription =
      simulation.filter().observe(kRecordAll, [&](const SnapshotPtr& s) {
        audit.take(s);
        series.take(s, audit.lastRecord());
        last = s;
      });
  while (simulation.step()) {
  }
  const SeriesRecord record = series.records().back();
  ASSERT_EQ(record.ids, last->ids);
  std::size_t k = 0;
  for (int i = 0; i < last->featureCount(); ++i) {
    for (int j = 0; j < i; ++j, ++k) {
      const double size = ellipseArea(relativeCovariance(*last, j, i));
      EXPECT_NEAR(record.sizes[k], size, 1e-6 * size);
    }
    const int row = Snapshot::row(i);
    const double own = ellipseArea(last->covariance.block2(row, row));
    EXPECT_NEAR(record.sizes[k++], own, 1e-6 * own);
  }
  EXPECT_EQ(record.sizes.size(), k);
}

TEST(ReportSeries, ClustersSpanTheirPairs) {
  Simulation simulation(oneLoop(1));
  Audit audit;
  ReportSeries series;
  const Subscription subscription =
      simulation.filter().observe(kRecordAll, [&](const SnapshotPtr& s) {
        audit.take(s);
        series.take(s, audit.lastRecord());
      });
  while (simulation.step()) {
  }
  const SeriesRecord record = series.records().back();
  ASSERT_EQ(record.clusters.size(), 3U);
  for (const ClusterSizes& pair : record.clusters) {
    float least = std::numeric_limits<float>::infinity();
    float greatest = 0.0F;
    std::size_t k = 0;
    for (std::size_t i = 0; i < record.ids.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j, ++k) {
        if (std::minmax(record.cluster[i], record.cluster[j]) != std::minmax(pair.a, pair.b)) {
          continue;
        }
        least = std::min(least, record.sizes[k]);
        greatest = std::max(greatest, record.sizes[k]);
      }
    }
    EXPECT_FLOAT_EQ(pair.least, least);
    EXPECT_FLOAT_EQ(pair.greatest, greatest);
    EXPECT_GT(pair.mean, 0.0F);
  }
}

TEST(ReportSeries, OfALargeMapKeepsTheBlamedAndTheLargest) {
  ReportSeries series;
  const auto map = rowOfFeatures(300);
  RecordFindings findings;
  findings.judged = 1;
  findings.broken = {Law::shrink};
  findings.features = {3, 4};
  series.take(map, findings);
  const SeriesRecord record = series.records().back();
  EXPECT_EQ(record.feature_count, 300);
  ASSERT_EQ(record.ids.size(), ReportSeries::kMostFeatures);
  EXPECT_EQ(record.sizes.size(), 60U * 61U / 2U);
  EXPECT_EQ(record.ids[0], 3U);
  EXPECT_EQ(record.ids[1], 4U);
  for (std::size_t k = 2; k < record.ids.size(); ++k) EXPECT_EQ(record.ids[k], 241U + k);
}

TEST(ReportSeries, TellsWhatIsNotFiniteFromWhatIsNotPositive) {
  auto map = rowOfFeatures(3);
  map->covariance(3, 3) = -1.0;
  map->covariance(7, 7) = std::numeric_limits<double>::quiet_NaN();
  ReportSeries series;
  RecordFindings findings;
  findings.judged = 1;
  series.take(map, findings);
  const SeriesRecord record = series.records().back();
  EXPECT_EQ(record.sizes[0], -1.0F);         // P of feature 1
  EXPECT_EQ(record.sizes[1], -1.0F);         // with feature 2
  EXPECT_GT(record.sizes[2], 0.0F);          // P of feature 2
  EXPECT_TRUE(std::isnan(record.sizes[3]));  // 1 and 3
  EXPECT_TRUE(std::isnan(record.sizes[5]));  // P of feature 3
  EXPECT_TRUE(record.clusters.empty());
}

TEST(ReportSeries, PassesOverWhatTheAuditPassedOver) {
  ReportSeries series;
  RecordFindings findings;
  findings.judged = 1;
  series.take(rowOfFeatures(3), findings);
  series.take(rowOfFeatures(3), findings);
  EXPECT_EQ(series.records().size(), 1U);
}

TEST(AuditLastRecord, AddsUpToTheReport) {
  SimulationOptions options = oneLoop(1);
  options.fault = "paper";
  options.fault_features = {8};
  Simulation simulation(options);
  Audit audit({}, simulation.header());
  std::map<Law, std::uint64_t> broken;
  std::uint64_t blamed = 0, others = 0, judged = 0;
  double nis = 0.0;
  int dof = 0;
  const Subscription subscription =
      simulation.filter().observe(kRecordAll, [&](const SnapshotPtr& s) {
        audit.take(s);
        const RecordFindings& findings = audit.lastRecord();
        EXPECT_EQ(findings.judged, ++judged);
        for (const Law law : findings.broken) ++broken[law];
        for (const FeatureId id : findings.features) ++(id == 8 ? blamed : others);
        nis += findings.nis;
        dof += findings.dof;
      });
  while (simulation.step()) {
  }
  const AuditReport report = audit.report();
  EXPECT_EQ(judged, report.records);
  EXPECT_EQ(broken[Law::shrink], report.law(Law::shrink).violations);
  EXPECT_EQ(broken[Law::support], report.law(Law::support).violations);
  EXPECT_EQ(broken.count(Law::motion), 0U);
  EXPECT_GT(blamed, 100U);
  EXPECT_EQ(others, 0U);
  EXPECT_NEAR(nis / dof, 1.0, 0.2);
}

}  // namespace
}  // namespace slamscope::slam
