// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "slam/angle.hpp"
#include "slam/csv_recording.hpp"
#include "slam/laser_front_end.hpp"
#include "slam/run_recording.hpp"
#include "slam/score.hpp"
#include "slam/simulation_random.hpp"
#include "tests/slam/central_differences.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double kNoReturn = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = std::numbers::pi / 180.0;

struct Post {
  Eigen::Vector2d centre;
  double radius;
};

/// Range along a ray to the nearest post, and to the wall x = `wall` (m); NaN for none.
double cast(const Eigen::Vector3d& laser, double angle, const std::vector<Post>& posts,
            double wall) {
  const Eigen::Vector2d ray(std::cos(laser[2] + angle), std::sin(laser[2] + angle));
  double nearest = ray.x() > 1e-6 ? (wall - laser[0]) / ray.x() : kNoReturn;
  for (const Post& post : posts) {
    const Eigen::Vector2d d = post.centre - laser.head<2>();
    const double along = d.dot(ray);
    const double squared = post.radius * post.radius - (d - along * ray).squaredNorm();
    if (along <= 0.0 || squared <= 0.0) continue;
    const double range = along - std::sqrt(squared);
    if (!(nearest <= range)) nearest = range;
  }
  return nearest;
}

/// A sweep over 180° in half degrees; the laser is at `poses(k / 360)` for return k.
template <typename Poses>
LaserScan sweep(Poses poses, const std::vector<Post>& posts, double wall, double sigma,
                RandomSource& random) {
  LaserScan scan;
  scan.angle_min = -90.0 * kDegree;
  scan.angle_step = 0.5 * kDegree;
  for (int k = 0; k <= 360; ++k) {
    scan.ranges.push_back(
        cast(poses(k / 360.0), scan.angle(static_cast<std::size_t>(k)), posts, wall) +
        sigma * random.normal());
  }
  return scan;
}

LaserScan still(const std::vector<Post>& posts, double wall = kNoReturn, double sigma = 0.0) {
  RandomSource random(3);
  return sweep([](double) { return Eigen::Vector3d(0, 0, 0); }, posts, wall, sigma, random);
}

TEST(LaserPoints, PostsAreFoundAndWallsAreNot) {
  const std::vector<Post> posts{{{4, 1}, 0.1}, {{3, -2}, 0.06}, {{6, 3}, 0.2}};
  const std::vector<LaserPoint> points = findPoints(still(posts, 9.0), {});
  ASSERT_EQ(points.size(), 3U);
  for (const LaserPoint& point : points) {
    const Eigen::Vector2d place = locateFeature(Sensor::range_bearing, {0, 0, 0}, point.z);
    const auto near = std::min_element(posts.begin(), posts.end(), [&](auto& a, auto& b) {
      return (a.centre - place).norm() < (b.centre - place).norm();
    });
    EXPECT_LT((near->centre - place).norm(), 0.05);
    EXPECT_NEAR(point.diameter, 2.0 * near->radius, 1.5 * 0.5 * kDegree * point.z[0]);
  }
}

TEST(LaserPoints, WhatIsPartOfSomethingLargerIsNoPoint) {
  EXPECT_TRUE(findPoints(still({{{4, 1}, 1.2}}), {}).empty()) << "too wide";
  EXPECT_TRUE(findPoints(still({{{4, 1}, 0.1}}, 4.3), {}).empty()) << "in front of a wall";
  EXPECT_EQ(findPoints(still({{{4, 1}, 0.1}}, 5.3), {}).size(), 1U);
  EXPECT_EQ(findPoints(still({{{4, 1}, 0.1}, {{3.0, 0.9}, 0.1}}), {}).size(), 1U)
      << "half of the farther one is hidden";
}

TEST(LaserPoints, TheirCovarianceIsHonest) {
  RandomSource random(8);
  double range = 0.0;
  double bearing = 0.0;
  constexpr int kRuns = 400;
  for (int k = 0; k < kRuns; ++k) {
    const double distance = random.uniform(2.0, 8.0);
    const double angle = random.uniform(-1.2, 1.2);
    const Post post{{distance * std::cos(angle), distance * std::sin(angle)},
                    random.uniform(0.08, 0.15)};
    const LaserScan scan =
        sweep([](double) { return Eigen::Vector3d(0, 0, 0); }, {post}, kNoReturn, 0.02, random);
    const auto points = findPoints(scan, {.range_sigma = 0.02, .shape_sigma = 0.0});
    ASSERT_EQ(points.size(), 1U);
    const Eigen::Vector2d error = points[0].z - Eigen::Vector2d(distance, angle);
    range += error[0] * error[0] / points[0].R(0, 0) / kRuns;
    bearing += error[1] * error[1] / points[0].R(1, 1) / kRuns;
  }
  EXPECT_GT(range, 0.4);
  EXPECT_LT(range, 1.6);
  EXPECT_GT(bearing, 0.4);
  EXPECT_LT(bearing, 1.6);
}

TEST(LaserPoints, ReflectorsAreFoundByTheirIntensityAlone) {
  LaserScan scan = still({{{4, 1}, 0.1}}, 4.2);
  EXPECT_TRUE(findPoints(scan, {.reflector_intensity = 100.0}).empty()) << "no intensities";
  scan.intensities.assign(scan.ranges.size(), 10.0);
  for (std::size_t k = 200; k < 204; ++k) scan.intensities[k] = 200.0;
  const auto points = findPoints(scan, {.reflector_intensity = 100.0});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].z[1], scan.angle(200) + 0.75 * kDegree, 1e-12);
}

TEST(LaserPoints, LooksPastOnlyWhatIsNotThere) {
  const LaserScan scan = still({{{4, 0}, 0.1}}, 9.0);
  const LaserPointOptions options;
  EXPECT_FALSE(seesPast(scan, options, 4.0, 0.0, 0.8, 0.01)) << "it is there";
  EXPECT_FALSE(seesPast(scan, options, 6.0, 0.0, 0.8, 0.01)) << "it is hidden";
  EXPECT_TRUE(seesPast(scan, options, 4.0, 0.3, 0.8, 0.01));
  EXPECT_FALSE(seesPast(scan, options, 9.2, 0.0 + 0.3, 0.8, 0.01)) << "behind the wall";
  EXPECT_FALSE(seesPast(scan, options, 4.0, 1.58, 0.8, 0.01)) << "out of the scan";
  EXPECT_FALSE(seesPast(scan, options, 4.0, 0.1, 0.8, 0.2)) << "not sure where to look";
  EXPECT_FALSE(seesPast(scan, options, kNoReturn, kNoReturn, 0.8, 0.2));
}

TEST(LaserFrontEnd, RespectsTheTimeWithinTheSweep) {
  const Eigen::Vector2d velocity(2.0, 1.0);
  const LaserMount mount{.pose_robot = {0.3, 0.1, 0.2}, .sweep = 0.1};
  const std::vector<Post> posts{{{4, 2.5}, 0.1}, {{4, -2}, 0.1}, {{2, 2.5}, 0.08}};
  RandomSource random(1);
  const auto moving = [&](double share) {
    return movePose(arcIncrement(velocity, 0.1 * share), mount.pose_robot);
  };
  const LaserScan scan = sweep(moving, posts, kNoReturn, 0.0, random);
  const auto worst = [&](const Eigen::Vector2d& believed) {
    double error = 0.0;
    const auto observations = LaserFrontEnd(mount, {}).observations(scan, believed);
    EXPECT_EQ(observations.size(), posts.size());
    for (const Observation& o : observations) {
      const Eigen::Vector2d place = locateFeature(Sensor::range_bearing, {0, 0, 0}, o.z);
      double nearest = 1e9;
      for (const Post& post : posts) nearest = std::min(nearest, (post.centre - place).norm());
      error = std::max(error, nearest);
    }
    return error;
  };
  EXPECT_LT(worst(velocity), 0.05);
  EXPECT_GT(worst({0, 0}), 0.1) << "must fail: the sweep taken for one moment";
}

TEST(LaserFrontEnd, JacobianOfTheMountIsTheDerivative) {
  RandomSource random(2);
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector3d mount(random.uniform(-1, 4), random.uniform(-1, 1),
                                random.uniform(-3, 3));
    const Eigen::VectorXd z = Eigen::Vector2d(random.uniform(5.0, 30.0), random.uniform(-3, 3));
    Eigen::Matrix2d J;
    EXPECT_TRUE(readingFromRobot(mount, z, &J).allFinite());
    const Eigen::MatrixXd numeric = testing::centralDifferences(
        [&](const Eigen::VectorXd& at) -> Eigen::VectorXd { return readingFromRobot(mount, at); },
        z,
        [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
          return observationDifference(Sensor::range_bearing, a, b);
        });
    EXPECT_LT(testing::relativeDifference(J, numeric), testing::kTolerance);
    J(1, 0) = -J(1, 0) + 1e-5;
    EXPECT_GT(testing::relativeDifference(J, numeric), testing::kTolerance) << "sign flipped";
  }
}

/// Somebody's folder of scans, and what becomes of it.
class CsvScans : public ::testing::Test {
 protected:
  CsvScans()
      : folder_(fs::temp_directory_path() / ("slamscope_scans" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    store("odometry.csv", "time_s,speed_mps,steering_rad\n0,1,0.1\n1,1,0.1\n2,1,0.1\n3,0,0\n");
    store("scans.csv", "time_s,angle_min_rad,angle_step_rad,r0,r1,r2\n1,-0.5,0.5,1,2,nan\n");
  }
  ~CsvScans() override { fs::remove_all(folder_); }
  void store(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] Recording read() const { return readCsv(folder_); }
  [[nodiscard]] std::string error() const {
    try {
      static_cast<void>(read());
    } catch (const std::runtime_error& thrown) {
      return fs::path(thrown.what()).filename();
    }
    return "";
  }
  fs::path folder_;
};

TEST_F(CsvScans, AreReadWithIntensities) {
  store("intensities.csv", "time_s,angle_min_rad,angle_step_rad,r0,r1,r2\n1,-0.5,0.5,7,8,9\n");
  const Recording recording = read();
  EXPECT_EQ(recording.odometry_kind, Recording::Odometry::ackermann);
  ASSERT_EQ(recording.scans.size(), 1U);
  EXPECT_EQ(recording.scans[0].ranges[1], 2.0);
  EXPECT_TRUE(std::isnan(recording.scans[0].ranges[2]));
  EXPECT_EQ(recording.scans[0].intensities, (std::vector<double>{7, 8, 9}));
  EXPECT_EQ(recording.scans[0].angle(2), 0.5);
  EXPECT_TRUE(recording.warnings.empty());
  EXPECT_THROW(RecordingRun(recording, {}), std::invalid_argument) << "known ids, and no wheelbase";
}

TEST_F(CsvScans, ErrorsNameFileLineAndColumn) {
  store("scans.csv", "time_s,angle_min_rad,angle_step_rad,r0\n1,-0.5,0.5,near\n");
  EXPECT_EQ(error(), "scans.csv:2: r0: expected a number, or nan for none, found near");
  store("scans.csv", "time_s,angle_min,angle_step_rad,r0\n");
  EXPECT_EQ(error(), "scans.csv:1: header: expected angle_min_rad, found angle_min");
  store("scans.csv", "time_s,angle_min_rad,angle_step_rad,r0\n1,0,0,3\n");
  EXPECT_EQ(error(), "scans.csv:2: angle_step_rad: expected an angle that is not 0, found 0");
  store("scans.csv", "time_s,angle_min_rad,angle_step_rad,r0\n2,0,1,3\n1,0,1,3\n");
  EXPECT_EQ(error().substr(0, 22), "scans.csv:3: time_s: e");
  store("scans.csv", "time_s,angle_min_rad,angle_step_rad,r0\n1,0,1,3\n");
  store("intensities.csv", "time_s,angle_min_rad,angle_step_rad,r0\n1,0,1,3,4\n");
  EXPECT_EQ(error(),
            "intensities.csv:2: row: expected 1 intensities, as the scan has ranges, found 2");
  store("range_bearing.csv", "time_s,range_m,bearing_rad\n1,2,0\n");
  EXPECT_NE(error().find("expected one of them"), std::string::npos);
}

TEST_F(CsvScans, BadScansAreSaidAndSurvived) {
  store("odometry.csv", "time_s,speed_mps,steering_rad\n0,1,5.7\n1,1,5.7\n200,1,5.7\n203,0,0\n");
  store("scans.csv",
        "time_s,angle_min_rad,angle_step_rad,r0,r1,r2\n"
        "1,-90,45,1,2,nan\n1,-90,45,1,2,nan\n2,-90,45,,,\n3,-90,45,1,2,3,4,5\n4,-90,45\n"
        "201,0,0.1,inf,-1,1e300\n");
  Recording recording = read();
  std::string all;
  for (const std::string& warning : recording.warnings) all += warning + "\n";
  EXPECT_NE(all.find("1 scans have the time of the one before"), std::string::npos) << all;
  EXPECT_NE(all.find("2 scans have another number of returns"), std::string::npos) << all;
  EXPECT_NE(all.find("2 scans have no return at all"), std::string::npos) << all;
  EXPECT_NE(all.find("steering of up to 5.7 rad; are these degrees?"), std::string::npos) << all;
  EXPECT_NE(all.find("angles of scans of up to 225 rad; are these degrees?"), std::string::npos)
      << all;
  EXPECT_NE(all.find("time jumps in the odometry, 1 times by more than 10 s"), std::string::npos)
      << all;
  recording.vehicle = {.wheelbase = 2.0};
  RecordingRun run(recording, {.association = Association::joint});
  while (run.step()) {
  }
  EXPECT_TRUE(run.filter().snapshot().finite());
}

TEST_F(CsvScans, BearingsInDegreesAreNoticed) {
  fs::remove(folder_ / "scans.csv");
  store("range_bearing.csv", "time_s,range_m,bearing_rad\n1,2,57\n2,2,-20\n");
  const Recording recording = read();
  EXPECT_FALSE(recording.ids_known);
  ASSERT_EQ(recording.warnings.size(), 1U);
  EXPECT_NE(recording.warnings[0].find("bearings of up to 57 rad; are these degrees?"),
            std::string::npos);
}

TEST(RecordingRun, SaysThatAnIdIsUsedForAnotherPlace) {
  const auto remarks = [](double moved_to) {
    Recording recording;
    for (int k = 0; k <= 40; ++k) recording.odometry.push_back({k * 250ms, {0.0, 0.0, 0.0}});
    for (int k = 1; k <= 40; ++k) {
      addSighting(recording, k * 250ms, {3, {2.0, 0.3}});
      addSighting(recording, k * 250ms, {4, {k < 20 ? 2.0 : moved_to, -0.3}});
    }
    RecordingRun run(recording, {});
    while (run.step()) {
    }
    EXPECT_TRUE(run.filter().snapshot().finite());
    return run.remarks();
  };
  EXPECT_TRUE(remarks(2.0).empty());
  ASSERT_EQ(remarks(6.0).size(), 1U);
  EXPECT_EQ(remarks(6.0)[0].substr(0, 35), "feature 4: 21 sightings in a row we");
}

}  // namespace
}  // namespace slamscope::slam
