// SPDX-License-Identifier: MIT
// apps/loggers/slamscope_log.hpp: what it writes reads back to the same bits.
#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <clocale>
#include <filesystem>
#include <fstream>

#include "apps/loggers/slamscope_log.hpp"
#include "slam/audit/audit.hpp"
#include "slam/run_reader.hpp"
#include "slam/run_writer.hpp"
#include "slam/simulation.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;

class FilterLog : public ::testing::Test {
 protected:
  ~FilterLog() override { fs::remove(path_); }
  [[nodiscard]] std::vector<SnapshotPtr> records() const {
    RunReader reader(path_);
    std::vector<SnapshotPtr> records;
    while (auto snapshot = reader.next()) records.push_back(*snapshot);
    return records;
  }

  const std::string path_ =
      fs::temp_directory_path() / ("slamscope_log" + std::to_string(::getpid()) + ".jsonl");
};

Eigen::VectorXd stateOf(const Snapshot& s) {
  Eigen::VectorXd x(3 + 2 * s.featureCount());
  x.head<3>() = s.pose;
  for (int k = 0; k < s.featureCount(); ++k) {
    x.segment<2>(Snapshot::row(k)) = s.features[static_cast<std::size_t>(k)];
  }
  return x;
}

/// Logs what a filter of ours publishes, as somebody would log theirs.
void logTo(Log& log, const Snapshot& s, std::vector<FeatureId>& known) {
  const Eigen::VectorXd x = stateOf(s);
  const Eigen::MatrixXd P = s.covariance.dense();
  const double t = 1e-9 * static_cast<double>(s.time.count());
  if (s.event == Event::predict) log.predicted(x, P, t);
  if (s.event == Event::update) log.updated(x, P, s.observed);
  if (s.event != Event::initialise) return;
  log.initialised(x, P, {s.ids.begin() + static_cast<std::ptrdiff_t>(known.size()), s.ids.end()});
  known = s.ids;
}

TEST_F(FilterLog, ReadsBackToTheSameBitsAndIsWhole) {
  Simulation simulation({.loops = 1});
  std::vector<SnapshotPtr> published;
  std::vector<FeatureId> known;
  Log log(path_, "range-bearing");
  const auto subscription = simulation.filter().observe([&](const SnapshotPtr& s) {
    if (s->event == Event::initial || s->event == Event::step) return;
    published.push_back(s);
    logTo(log, *s, known);
  });
  while (simulation.step()) {
  }
  Audit audit;
  const auto read = records();
  ASSERT_EQ(read.size(), published.size());
  ASSERT_GT(read.size(), 100U);
  for (std::size_t k = 0; k < read.size(); ++k) {
    ASSERT_EQ(read[k]->event, published[k]->event);
    ASSERT_EQ(read[k]->ids, published[k]->ids);
    ASSERT_EQ(read[k]->pose, published[k]->pose);
    ASSERT_EQ(read[k]->features, published[k]->features);
    ASSERT_TRUE(
        std::ranges::equal(read[k]->covariance.packed(), published[k]->covariance.packed()));
    ASSERT_EQ(read[k]->observed_given, read[k]->event == Event::update);
    audit.take(read[k]);
  }
  const AuditReport report = audit.report();
  EXPECT_EQ(report.level, "L2");
  EXPECT_EQ(report.verdict, Verdict::ok);
}

TEST_F(FilterLog, TakesVectorsNestedListsAndFlatOnes) {
  const std::vector<double> x{1, 2, 3, 4, 5};
  std::vector<std::vector<double>> nested(5, std::vector<double>(5));
  std::vector<float> flat(25);
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < 5; ++j) nested[i][j] = flat[5 * i + j] = float(10 * i + j);
  }
  Log log(path_, "unknown", R"("R": [[1, 0], [0, 2]])");
  log.initialised(x, nested);
  log.predicted(x, flat);
  log.updated(x, flat);
  const auto read = records();
  ASSERT_EQ(read.size(), 3U);
  for (const SnapshotPtr& record : read) {
    EXPECT_EQ(record->ids, std::vector<FeatureId>{1});
    EXPECT_EQ(record->covariance(4, 3), 43.0) << "the lower triangle";
    EXPECT_EQ(record->asymmetry, 36.0);
  }
  EXPECT_EQ(read[1]->time, std::chrono::seconds(1)) << "predictions are counted";
  EXPECT_FALSE(read[2]->observed_given);
  EXPECT_EQ((*RunReader(path_).header().R)(1, 1), 2.0);
}

TEST_F(FilterLog, WritesWhatADivergingFilterHolds) {
  const std::vector<double> x{std::nan(""), 1e300, -1.0 / 0.0};
  Log log(path_);
  log.predicted(x, std::vector<double>(9, 1.0 / 0.0), 0.1);
  const auto read = records();
  ASSERT_EQ(read.size(), 1U);
  EXPECT_TRUE(std::isnan(read[0]->pose.x()));
  EXPECT_EQ(read[0]->pose.y(), 1e300);
  EXPECT_EQ(read[0]->pose.z(), -1.0 / 0.0);
  EXPECT_EQ(read[0]->covariance(2, 2), 1.0 / 0.0);
}

TEST_F(FilterLog, FeaturesWithoutIdsAmongNamedOnesAreRefused) {
  Log log(path_);
  const Eigen::VectorXd five = Eigen::VectorXd::Zero(5), seven = Eigen::VectorXd::Zero(7);
  log.initialised(five, Eigen::MatrixXd::Identity(5, 5), {42});
  EXPECT_THROW(log.updated(seven, Eigen::MatrixXd::Identity(7, 7)), std::invalid_argument);
  log.initialised(seven, Eigen::MatrixXd::Identity(7, 7), {7});
  log.removed(five, Eigen::MatrixXd::Identity(5, 5), {42});
  EXPECT_EQ(records().back()->ids, std::vector<FeatureId>{7});
}

}  // namespace
}  // namespace slamscope::slam
