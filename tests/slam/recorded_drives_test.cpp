// SPDX-License-Identifier: MIT
// Recorded data of others: the whole way from file to score.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "slam/audit/audit.hpp"
#include "slam/formats/isam_graph.hpp"
#include "slam/formats/mrpt_sightings.hpp"
#include "slam/formats/victoria_park.hpp"
#include "slam/mrclam.hpp"
#include "slam/recording_defaults.hpp"
#include "slam/score.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> dataFolder(const std::string& name) {
  const char* given = std::getenv("SLAMSCOPE_DATA");
  const fs::path folder =
      given != nullptr ? fs::path(given) : fs::path(SLAMSCOPE_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(folder / name)) return std::nullopt;
  return folder / name;
}

#define SKIP_WITHOUT(folder, name) \
  if (!(folder))                   \
  GTEST_SKIP() << "no recorded data: " name " is neither in $SLAMSCOPE_DATA nor beside"

struct Driven {
  Score score;
  int features;
};

Driven drive(const Recording& recording, Association association) {
  RecordingRun run(recording, usualOptions(recording, association));
  const Scorer scorer(run.filter(), run.recording());
  while (run.step()) {
  }
  EXPECT_TRUE(run.filter().snapshot().finite());
  const auto names = run.hiddenNames();
  return {names.empty() ? scorer.score() : scorer.score(run.recording(), names),
          run.filter().state().featureCount()};
}

/// What the audit, level L2, says of the first `steps` time steps.
AuditReport audited(const Recording& recording, const RecordingRunOptions& options, int steps,
                    const AuditOptions& rules = {}) {
  RecordingRun run(recording, options);
  Audit audit(rules, run.header());
  const Subscription listening = audit.listen(run.filter());
  for (int k = 0; k < steps && run.step(); ++k) {
  }
  return audit.report();
}

class MrclamHidden : public ::testing::TestWithParam<int> {};

/// Landmarks stand in clusters, 0.18 m from each other, where a range is off by 0.2 m.
TEST_P(MrclamHidden, JointMapsEachLandmarkOnceWithoutIds) {
  const auto folder = dataFolder("mrclam");
  SKIP_WITHOUT(folder, "mrclam");
  const Recording recording = readMrclam(*folder, GetParam());
  const Driven joint = drive(recording, Association::joint);
  EXPECT_EQ(joint.features, 15);
  EXPECT_EQ(joint.score.features_found, 15);
  EXPECT_EQ(joint.score.duplicates, 0);
  // On robots 1 and 4 a cluster that is new is taken for a known one after a long blind drive.
  const bool lost_for_a_while = GetParam() == 1 || GetParam() == 4;
  const Driven known = drive(recording, Association::known);
  const double worse = lost_for_a_while ? 10.0 : 1.5;
  EXPECT_LE(*joint.score.features_rms_aligned, worse * *known.score.features_rms_aligned);
  EXPECT_LE(*joint.score.path_rms_aligned, worse * *known.score.path_rms_aligned);
}

TEST_P(MrclamHidden, TheAuditFindsNoFaultInTheCode) {
  const auto folder = dataFolder("mrclam");
  SKIP_WITHOUT(folder, "mrclam");
  const Recording recording = readMrclam(*folder, GetParam());
  for (const Association association : {Association::nearest, Association::joint}) {
    const AuditReport report = audited(recording, usualOptions(recording, association), 100'000);
    EXPECT_GT(report.records, 1000U);
    EXPECT_FALSE(report.found(FaultClass::code));
  }
}
INSTANTIATE_TEST_SUITE_P(Robots, MrclamHidden, ::testing::Range(1, 6));

TEST(VictoriaPark, TheWholeDriveFromRawScansStaysWithTheGps) {
  const auto folder = dataFolder("victoria_park_raw");
  SKIP_WITHOUT(folder, "victoria_park_raw");
  const Recording recording = readVictoriaPark(*folder);
  EXPECT_EQ(recording.scans.size(), 7230U);
  const Driven driven = drive(recording, Association::joint);
  EXPECT_LE(*driven.score.path_rms_aligned, 5.0);
  EXPECT_GE(driven.score.path_samples, 500U);
  EXPECT_LE(driven.features, 600);
}

TEST(VictoriaPark, ScoreRejectsWheelsWithoutALaser) {
  const auto folder = dataFolder("victoria_park_raw");
  SKIP_WITHOUT(folder, "victoria_park_raw");
  Recording recording = readVictoriaPark(*folder);
  for (LaserScan& scan : recording.scans) scan.ranges.clear();
  EXPECT_GT(*drive(recording, Association::joint).score.path_rms_aligned, 5.0);
}

/// The whole drive is audited by hand (tests/experiments/README.md): it takes a minute.
TEST(VictoriaPark, TheAuditFindsNoFaultInTheCode) {
  const auto folder = dataFolder("victoria_park_raw");
  SKIP_WITHOUT(folder, "victoria_park_raw");
  const Recording recording = readVictoriaPark(*folder);
  const AuditReport report = audited(recording, usualOptions(recording, Association::joint), 800);
  EXPECT_GT(report.records, 2000U);
  EXPECT_FALSE(report.found(FaultClass::code));
}

TEST(IsamGraph, TheAuditFindsNoFaultInTheCode) {
  const auto file = dataFolder("victoria_park_isam");
  SKIP_WITHOUT(file, "victoria_park_isam");
  const Recording recording = readIsamGraph((*file / "victoriaPark.txt").string());
  RecordingRunOptions options = usualOptions(recording, Association::known);
  EXPECT_FALSE(audited(recording, options, 1500).found(FaultClass::code));
  options.first_estimates = true;
  EXPECT_FALSE(audited(recording, options, 1500, {.allow = {Allow::fej}}).found(FaultClass::code));
}

TEST(MrptSightings, AreMappedWithoutAnyOdometry) {
  const auto file = dataFolder("mrpt_kfslam/kf-slam_demo_range_bearing.txt");
  SKIP_WITHOUT(file, "mrpt_kfslam");
  const Recording recording = readMrptSightings(*file);
  EXPECT_EQ(recording.sightings.size(), 249U);
  EXPECT_TRUE(recording.odometry.empty());
  RecordingRunOptions options = usualOptions(recording, Association::known);
  options.sensor_sigma = {0.05, 0.01};
  RecordingRun run(recording, options);
  const Scorer scorer(run.filter());
  while (run.step()) {
  }
  EXPECT_EQ(scorer.score().features_found, run.filter().state().featureCount());
  EXPECT_LT(*scorer.score().features_rms_aligned, 0.1);
  EXPECT_LT(*scorer.score().path_rms_aligned, 0.1);
  EXPECT_FALSE(audited(recording, options, 1000).found(FaultClass::code));
}

}  // namespace
}  // namespace slamscope::slam
