// SPDX-License-Identifier: MIT
#include "slam/run_recording.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "slam/mrclam.hpp"
#include "slam/score.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Where recorded data lies, or nothing.
std::optional<fs::path> recordedData(const std::string& name) {
  const char* given = std::getenv("SLAMSCOPE_DATA");
  const fs::path folder =
      given != nullptr ? fs::path(given) : fs::path(SLAMSCOPE_SOURCE_DIR) / "../shared/data";
  if (!fs::exists(folder / name)) return std::nullopt;
  return folder / name;
}

/// A robot that drives an arc past two features and reads them without noise.
Recording arcRecording(Recording::Odometry kind) {
  Recording recording;
  recording.odometry_kind = kind;
  const Eigen::Vector3d moved = arcIncrement({0.5, 0.3}, 0.25);
  const bool velocity = kind == Recording::Odometry::velocity;
  for (int k = 0; k <= 40; ++k) {
    recording.odometry.push_back({k * 250ms, velocity ? Eigen::Vector3d(0.5, 0.0, 0.3) : moved});
  }
  for (int k = 1; k <= 19; ++k) {
    const auto time = k * 510ms;
    const Eigen::Vector3d pose = arcIncrement({0.5, 0.3}, 0.51 * k);
    recording.truth_path.push_back({time, pose});
    for (const auto& [id, feature] :
         {std::pair{FeatureId{3}, Eigen::Vector2d(2, 1)}, {FeatureId{9}, Eigen::Vector2d(0, 3)}}) {
      const Eigen::Vector2d z = observeFeature(Sensor::range_bearing, pose, feature);
      addSighting(recording, time, {id, z});
    }
  }
  return recording;
}

double worstPathError(RecordingRun& run) {
  double worst = 0.0;
  const auto subscription = run.filter().observe({Event::step}, [&](const SnapshotPtr& snapshot) {
    const auto truth = run.recording().truthAt(snapshot->time);
    worst = std::max(worst, (snapshot->pose - truth.value()).norm());
  });
  while (run.step()) {
  }
  return worst;
}

TEST(RecordingRun, IntegratesVelocitiesExactlyUpToEachSighting) {
  RecordingRun run(arcRecording(Recording::Odometry::velocity), {});
  EXPECT_LT(worstPathError(run), 1e-9);
  EXPECT_EQ(run.progress(), 1.0);
  EXPECT_EQ(run.filter().state().featureCount(), 2);
}

TEST(RecordingRun, IntegratesIncrementsAndSplitsThemBetweenRows) {
  RecordingRun run(arcRecording(Recording::Odometry::increment), {});
  EXPECT_LT(worstPathError(run), 2e-3) << "a row is split along its chord, not its arc";
}

TEST(RecordingRun, PathComparatorRejectsAWrongTurn) {
  Recording recording = arcRecording(Recording::Odometry::velocity);
  for (auto& entry : recording.odometry) entry.motion[2] = -0.3;
  RecordingRun run(recording, {});
  EXPECT_GT(worstPathError(run), 0.05);
}

TEST(RecordingRun, PublishesInitialOnceAndOneStepForEachTimeOfSightings) {
  Recording recording = arcRecording(Recording::Odometry::velocity);
  recording.sightings.erase(recording.sightings.begin() + 3, recording.sightings.begin() + 12);
  RecordingRun run(recording, {});
  std::array<int, 6> count{};
  const auto subscription = run.filter().observe(
      [&](const SnapshotPtr& snapshot) { ++count.at(static_cast<std::size_t>(snapshot->event)); });
  double progress = 0.0;
  while (run.step()) {
    EXPECT_GE(run.progress(), progress);
    progress = run.progress();
  }
  EXPECT_EQ(count[static_cast<std::size_t>(Event::initial)], 1);
  EXPECT_EQ(count[static_cast<std::size_t>(Event::step)], 10);
  EXPECT_EQ(count[static_cast<std::size_t>(Event::predict)], 10 + 5)
      << "the gap of 5.1 s is predicted over once a second";
}

TEST(RecordingRun, NoiseDoesNotDependOnTheRateOfTheOdometry) {
  const auto sigma = [](std::chrono::nanoseconds interval) {
    Recording recording;
    for (auto time = 0ns; time <= 10s; time += interval) {
      recording.odometry.push_back({time, {0.5, 0.0, 0.2}});
    }
    addSighting(recording, 10s, {1, {1.0, 0.0}});
    RecordingRun run(recording, {.longest_prediction = 100s});
    while (run.step()) {
    }
    return run.filter().snapshot().covariance(2, 2);
  };
  EXPECT_NEAR(sigma(10ms), 10.0 * 0.05 * 0.05, 1e-9);
  EXPECT_NEAR(sigma(500ms), sigma(10ms), 1e-9);
}

TEST(RecordingRun, UsesTheSigmasOfTheRecording) {
  Recording recording = arcRecording(Recording::Odometry::velocity);
  RecordingRun constant(recording, {});
  EXPECT_TRUE(constant.header().R.has_value());
  recording.sightings[0].seen[0].R = Eigen::Matrix2d(Eigen::Vector2d(1.0, 0.25).asDiagonal());
  RecordingRun own(recording, {});
  EXPECT_FALSE(own.header().R.has_value());
  for (int k = 0; k < 2; ++k) {
    constant.step();
    own.step();
  }
  EXPECT_GT(own.filter().snapshot().covariance(3, 3),
            2.0 * constant.filter().snapshot().covariance(3, 3));
}

TEST(RecordingRun, RefusesNoiseThatIsNone) {
  EXPECT_THROW(RecordingRun(Recording(), {.sensor_sigma = {0.0, 0.1}}), std::invalid_argument);
  EXPECT_THROW(RecordingRun(Recording(), {.odometry_sigma = {-1, 0, 0}}), std::invalid_argument);
}

class MrclamRun : public ::testing::TestWithParam<int> {};

TEST_P(MrclamRun, FindsAllFeaturesWithinTheFloors) {
  const auto folder = recordedData("mrclam");
  if (!folder) GTEST_SKIP() << "no recorded data: mrclam is neither in $SLAMSCOPE_DATA nor beside";
  for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
    RecordingRun run(readMrclam(*folder, GetParam()), {.update = update});
    const Scorer scorer(run.filter());
    while (run.step()) {
    }
    const Score score = scorer.score();
    EXPECT_EQ(score.features_found, 15);
    EXPECT_LE(*score.features_rms_aligned, 0.15);
    EXPECT_LE(*score.path_rms_aligned, 0.5);
    EXPECT_TRUE(run.filter().snapshot().finite());
    EXPECT_LT(run.filter().counters().gated_out, 20U) << "rejecting good sightings is divergence";
  }
}
INSTANTIATE_TEST_SUITE_P(Robots, MrclamRun, ::testing::Range(1, 6));

TEST(MrclamScore, RejectsAFilterThatBelievesItsOdometryTooMuch) {
  const auto folder = recordedData("mrclam");
  if (!folder) GTEST_SKIP() << "no recorded data: mrclam is neither in $SLAMSCOPE_DATA nor beside";
  RecordingRun run(readMrclam(*folder, 3), {.odometry_sigma = {0.005, 0.0, 0.01}});
  const Scorer scorer(run.filter());
  while (run.step()) {
  }
  EXPECT_GT(*scorer.score().path_rms_aligned, 0.5);
}

}  // namespace
}  // namespace slamscope::slam
