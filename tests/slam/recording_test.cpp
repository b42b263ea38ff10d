// SPDX-License-Identifier: MIT
#include "slam/recording.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "slam/csv_recording.hpp"
#include "slam/decimal_time.hpp"
#include "slam/formats/isam_graph.hpp"
#include "slam/formats/mrpt_sightings.hpp"
#include "slam/formats/victoria_park.hpp"
#include "slam/mrclam.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// A folder of small text files, gone with the test.
class RecordingFiles : public ::testing::Test {
 protected:
  RecordingFiles() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("slamscope_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~RecordingFiles() override { fs::remove_all(folder_); }

  void store(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// The message without the folder's name, or "" where all can be read.
  template <class Read>
  [[nodiscard]] std::string errorOf(Read read) const {
    try {
      read();
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      const std::string prefix = folder_.string() + "/";
      return text.starts_with(prefix) ? text.substr(prefix.size()) : text;
    }
    return "";
  }

  fs::path folder_;
};

class Csv : public RecordingFiles {
 protected:
  Csv() {
    store("odometry.csv", "time_s,forward_mps,turn_radps\n0,0.5,0\n1,0.5,0.25\n2,0,0\n");
    store("range_bearing.csv",
          "time_s,id,range_m,bearing_rad\n1,7,2.0,0.1\n1,8,3,-0.1\n2,7,1.9,0\n");
  }
  [[nodiscard]] Recording read() const { return readCsv(folder_); }
  [[nodiscard]] std::string error() const {
    return errorOf([&] { (void)read(); });
  }
  [[nodiscard]] std::string errorWithOdometry(const std::string& text) const {
    store("odometry.csv", text);
    return error();
  }
  [[nodiscard]] std::string errorWithSightings(const std::string& text) const {
    store("range_bearing.csv", text);
    return error();
  }
};

TEST_F(Csv, VelocitiesAndSightingsAreRead) {
  const Recording recording = read();
  EXPECT_EQ(recording.odometry_kind, Recording::Odometry::velocity);
  ASSERT_EQ(recording.odometry.size(), 3U);
  EXPECT_EQ(recording.odometry[1].time, 1s);
  EXPECT_EQ(recording.odometry[1].motion, Eigen::Vector3d(0.5, 0, 0.25));
  ASSERT_EQ(recording.sightings.size(), 2U);
  ASSERT_EQ(recording.sightings[0].seen.size(), 2U);
  EXPECT_EQ(recording.sightings[0].seen[1].id, 8U);
  EXPECT_EQ(recording.sightings[0].seen[1].z[1], -0.1);
  EXPECT_FALSE(recording.sightings[0].seen[1].R);
  EXPECT_EQ(recording.equal_stamps, 1U);
  EXPECT_TRUE(recording.warnings.empty()) << "several features at one time are nothing odd";
  EXPECT_FALSE(recording.truth_in_map);
  EXPECT_EQ(recording.end(), 2s);
}

TEST_F(Csv, IncrementsSigmasAndColumnsInAnyOrderAreRead) {
  store("odometry.csv",
        "\xef\xbb\xbf# wheels\r\ndtheta_rad, dx_m , time_s,\"dy_m\"\r\n0.1,0.2,5,0.3\r\n\r\n");
  store("range_bearing.csv",
        "id,sigma_range_m,sigma_bearing_rad,time_s,range_m,bearing_rad\n3,0.1,0.02,5,1,2\n4,,,5,1,"
        "2\n");
  const Recording recording = read();
  EXPECT_EQ(recording.odometry_kind, Recording::Odometry::increment);
  EXPECT_EQ(recording.odometry[0].motion, Eigen::Vector3d(0.2, 0.3, 0.1));
  EXPECT_EQ(recording.sightings[0].seen[0].R->diagonal(), Eigen::Vector2d(0.1 * 0.1, 0.02 * 0.02));
  EXPECT_FALSE(recording.sightings[0].seen[1].R);
}

TEST_F(Csv, TruthIsMovedIntoTheFrameOfTheMap) {
  store("truth_path.csv",
        "time_s,x_m,y_m,theta_rad\n-1,9,9,9\n0,2,1,1.5707963267948966\n2,2,3,1.5707963267948966\n");
  store("truth_features.csv", "id,x_m,y_m\n7,2,4\n8,1,1\n");
  const Recording recording = read();
  EXPECT_TRUE(recording.truth_in_map);
  EXPECT_TRUE(recording.truthAt(0s)->isZero(1e-12));
  EXPECT_TRUE(recording.truthAt(1s)->isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_FALSE(recording.truthAt(3s));
  EXPECT_TRUE(recording.truth_features[0].second.isApprox(Eigen::Vector2d(3, 0), 1e-12));
  EXPECT_TRUE(recording.truth_features[1].second.isApprox(Eigen::Vector2d(0, 1), 1e-12));
}

TEST_F(Csv, TruthThatBeginsLateIsTakenFromItsFirstPoseWithAWarning) {
  store("truth_path.csv", "time_s,x_m,y_m,theta_rad\n1,5,5,0\n2,6,5,0\n");
  const Recording recording = read();
  EXPECT_TRUE(recording.truthAt(1s)->isZero());
  EXPECT_EQ(recording.warnings.size(), 1U);
}

TEST_F(Csv, OddStampsAreCountedAndWarnedOf) {
  store("odometry.csv", "time_s,dx_m,dy_m,dtheta_rad\n0,0,0,0\n1,1,0,0\n1,1,0,0\n1,1,0,0\n");
  store("range_bearing.csv", "time_s,id,range_m,bearing_rad\n1,7,2,0\n1,7,2,0\n");
  const Recording recording = read();
  ASSERT_EQ(recording.warnings.size(), 2U);
  EXPECT_TRUE(recording.warnings[0].ends_with(": 2 rows have the time of the row before"));
  EXPECT_TRUE(recording.warnings[1].ends_with(": 1 sightings have time and id of another one"));
}

TEST_F(Csv, ErrorsNameFileLineAndColumn) {
  EXPECT_EQ(error(), "");
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps,turn_radps\n0,0,0\n1,fast,0\n"),
            "odometry.csv:3: forward_mps: expected a number, found fast");
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps,turn_radps\n0,0,nan\n"),
            "odometry.csv:2: turn_radps: expected a number, found nan");
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps,turn_radps\n0,0\n"),
            "odometry.csv:2: row: expected 3 values, found 2");
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps,turn_radps\n0,0,0\n2,0,0\n1.5,0,0\n"),
            "odometry.csv:4: time_s: expected at least 2 as in the row before, found 1.5");
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps,turn_radps\nsoon,0,0\n"),
            "odometry.csv:2: time_s: expected a number of seconds, found soon");
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps,turn_radps\n0,,0\n"),
            "odometry.csv:2: forward_mps: expected a number, found nothing");
}

TEST_F(Csv, AnUnknownColumnIsAnsweredWithTheNearestKnown) {
  EXPECT_EQ(errorWithOdometry("time_s,foward_mps,turn_radps\n0,0,0\n"),
            "odometry.csv:1: foward_mps: expected a column of "
            "time_s,forward_mps,turn_radps,speed_mps,steering_rad,dx_m,dy_m,dtheta_rad, found an "
            "unknown name (nearest: "
            "forward_mps)");
  EXPECT_EQ(errorWithOdometry("0,0.5,0\n1,0.5,0\n").substr(0, 18), "odometry.csv:1: 0:")
      << "a file without header";
  EXPECT_EQ(errorWithOdometry("time_s,forward_mps\n0,0\n"),
            "odometry.csv:1: turn_radps: expected a column of this name beside the others, found "
            "none");
  EXPECT_EQ(errorWithOdometry("time_s,dx_m,dy_m,dy_m\n"),
            "odometry.csv:1: dy_m: expected each column once, found two of them");
}

TEST_F(Csv, WrongSightingsAreRefused) {
  const std::string header = "time_s,id,range_m,bearing_rad,sigma_range_m,sigma_bearing_rad\n";
  EXPECT_EQ(errorWithSightings(header + "1,7,2,0,0.1,0.1\n"), "");
  EXPECT_EQ(errorWithSightings(header + "1,-7,2,0,0.1,0.1\n"),
            "range_bearing.csv:2: id: expected a whole number, not negative, found -7");
  EXPECT_EQ(errorWithSightings(header + "1,7,-2,0,0.1,0.1\n"),
            "range_bearing.csv:2: range_m: expected a number above 0, found -2");
  EXPECT_EQ(errorWithSightings(header + "1,7,2,0,0,0.1\n"),
            "range_bearing.csv:2: sigma_range_m: expected a number above 0, found 0");
  EXPECT_EQ(errorWithSightings(header + "1,7,2,0,0.1,0.1\n0.5,7,2,0,0.1,0.1\n"),
            "range_bearing.csv:3: time_s: expected at least 1 as in the row before, found 0.5");
  EXPECT_EQ(errorWithSightings(header),
            folder_.string() + ": expected sightings of features, found none");
  EXPECT_EQ(errorWithSightings("").substr(0, 20), "range_bearing.csv:0:");
}

TEST_F(Csv, MissingFilesAreNamed) {
  fs::remove(folder_ / "range_bearing.csv");
  EXPECT_EQ(error(), "range_bearing.csv: can't be opened (No such file or directory)");
  fs::remove(folder_ / "odometry.csv");
  EXPECT_EQ(error(), "odometry.csv: can't be opened (No such file or directory)");
  EXPECT_THROW((void)readCsv("/nowhere"), std::runtime_error);
}

class Mrclam : public RecordingFiles {
 protected:
  Mrclam() {
    store("Barcodes.dat", "# Subject Barcode\n  1 \t 5 \n  6 \t 63 \n  7 \t 81 \n");
    store("Robot2_Odometry.dat", "# t v w\n100.000 \t 0.1 \t 0.0 \n100.5 0.1 0.2\n");
    store(
        "Robot2_Measurement.dat",
        "# t s r b\n100.1 63 2.0 0.1\n100.1 81 3.0 0.2\n100.1 99 1 0\n100.2 5 1 0\n100.2 98 1 0\n");
  }
  [[nodiscard]] std::string error() const {
    return errorOf([&] { (void)readMrclam(folder_, 2); });
  }
};

TEST_F(Mrclam, MapsBarcodesAndCountsWhatIsNoLandmark) {
  const Recording recording = readMrclam(folder_, 2);
  ASSERT_EQ(recording.sightings.size(), 1U);
  EXPECT_EQ(recording.sightings[0].seen[0].id, 6U);
  EXPECT_EQ(recording.sightings[0].seen[1].id, 7U);
  EXPECT_EQ(recording.unknown_ids, 2U);
  EXPECT_EQ(recording.ignored_sightings, 1U);
  EXPECT_EQ(recording.equal_stamps, 1U);
  EXPECT_EQ(recording.warnings.size(), 2U) << "one for all unknown barcodes, one for equal stamps";
  EXPECT_EQ(recording.odometry[1].motion, Eigen::Vector3d(0.1, 0, 0.2));
}

TEST_F(Mrclam, ErrorsNameFileLineAndColumn) {
  store("Robot2_Odometry.dat", "# t v w\n100 0.1 0.0\n99 0.1 0.2\n");
  EXPECT_EQ(error(),
            "Robot2_Odometry.dat:3: time: expected at least 100 as in the row before, found 99");
  store("Robot2_Odometry.dat", "100 0.1 x\n");
  EXPECT_EQ(error(), "Robot2_Odometry.dat:1: angular velocity: expected a number, found x");
  fs::remove(folder_ / "Barcodes.dat");
  store("Robot2_Odometry.dat", "100 0.1 0\n");
  EXPECT_EQ(error(), "Barcodes.dat: can't be opened (No such file or directory)");
  EXPECT_THROW((void)readMrclam(folder_, 9), std::runtime_error);
}

TEST_F(RecordingFiles, IsamGraphsMayLeaveOutNumbers) {
  store("g.txt",
        "ODOMETRY 0 1 1 0 0.1 100 0 0 500 0 500\nLANDMARK 1 2 3 4 2 0 4\n"
        "ODOMETRY 1 3 1 0 0.1 100 0 0 500 0 500\nLANDMARK 3 2 2 4 2 0 4\n");
  const Recording recording = readIsamGraph(folder_ / "g.txt");
  EXPECT_EQ(recording.sensor, Sensor::relative_position);
  ASSERT_EQ(recording.odometry.size(), 3U);
  EXPECT_EQ(recording.odometry[2].time, 300ms);
  EXPECT_TRUE(recording.odometry[1].M->isApprox(
      Eigen::Matrix3d(Eigen::Vector3d(1e-4, 4e-6, 4e-6).asDiagonal())));
  EXPECT_TRUE(recording.sightings[1].seen[0].R->isApprox(
      Eigen::Matrix2d(Eigen::Vector2d(0.25, 0.0625).asDiagonal())));
  const auto error = [&](const std::string& text) {
    store("g.txt", text);
    return errorOf([&] { static_cast<void>(readIsamGraph(folder_ / "g.txt")); });
  };
  EXPECT_EQ(error("ODOMETRY 1 2 1 0 0 1 0 0 1 0 1\n"),
            "g.txt:1: pose: expected 0, the newest one, found 1");
  EXPECT_EQ(error("EDGE 1 2\n"), "g.txt:1: line: expected ODOMETRY or LANDMARK, found EDGE");
  EXPECT_EQ(error("LANDMARK 0 2 1 1 0 0 1\n"),
            "g.txt:1: sqrtinf: expected a diagonal without zeros, found 0");
}

TEST_F(RecordingFiles, MrptSightingsErrorsNameFileLineAndColumn) {
  store("a.txt", "% stamp index id range yaw pitch\n1.0 0 -1 2.0 0.1 0\n1.0 1 5 3.0 0.2 0\n");
  const Recording recording = readMrptSightings(folder_ / "a.txt");
  EXPECT_FALSE(recording.ids_known);
  ASSERT_EQ(recording.sightings.size(), 1U);
  EXPECT_EQ(recording.sightings[0].seen[1].z, Eigen::Vector2d(3.0, 0.2));
  store("a.txt", "1.0 0 7 -2.0 0.1 0\n");
  EXPECT_EQ(errorOf([&] { static_cast<void>(readMrptSightings(folder_ / "a.txt")); }),
            "a.txt:1: range: expected a number above 0, found -2.0");
}

TEST_F(RecordingFiles, VictoriaParkSaysWhatIsCutOff) {
  store("DRS.txt", "0.1 1.0 0.1\n0.2 1.0 0.1\n");
  store("GPS.txt", "0.1 0 0\n0.3 0.1 0.1\n0.5 50 50\n0.7 0.2 0.2\n");
  std::string scan = "0.15";
  for (int k = 0; k < 361; ++k) scan += k == 10 ? " 5.5" : " 81.91";
  store("LASER.txt", scan + " 0.25 1 2");
  const Recording recording = readVictoriaPark(folder_);
  ASSERT_EQ(recording.scans.size(), 1U);
  EXPECT_EQ(recording.scans[0].ranges[10], 5.5);
  EXPECT_TRUE(std::isnan(recording.scans[0].ranges[11]));
  EXPECT_EQ(recording.truth_path.size(), 3U) << "one fix jumps";
  EXPECT_EQ(recording.warnings.size(), 2U);
  store("DRS.txt", "0.1 1.0 x\n");
  EXPECT_EQ(errorOf([&] { static_cast<void>(readVictoriaPark(folder_)); }),
            "DRS.txt: number 3: expected a number, found x");
}

TEST(Recording, TruthIsInterpolatedTheShortWayRound) {
  Recording recording;
  recording.truth_path = {{0s, {0, 0, 3.0}}, {2s, {2, 4, -3.0}}};
  const Eigen::Vector3d pose = *recording.truthAt(1s);
  EXPECT_NEAR(pose.x(), 1.0, 1e-12);
  EXPECT_NEAR(pose.y(), 2.0, 1e-12);
  EXPECT_NEAR(std::abs(pose[2]), std::numbers::pi, 1e-12);
}

TEST(DecimalTime, IsTakenAsWritten) {
  EXPECT_EQ(parseSeconds("1248444175.103")->count(), 1248444175103000000);
  EXPECT_EQ(parseSeconds("0.1234567891")->count(), 123456789);
  EXPECT_EQ(parseSeconds("-0.5")->count(), -500000000);
  EXPECT_EQ(parseSeconds("+2.")->count(), 2000000000);
  EXPECT_EQ(parseSeconds("1e3")->count(), 1000000000000);
  EXPECT_EQ(parseSeconds(".5")->count(), 500000000);
  for (const std::string_view text : {"", "-", "x", "1s", "nan", "inf", "1e300", "--1", "1.2.3"}) {
    EXPECT_FALSE(parseSeconds(text)) << text;
  }
}

TEST(DecimalTime, IsWrittenBackExactly) {
  for (const std::string_view text :
       {"1248444175.103", "-0.5", "2", "0", "0.000000001", "-3.05", "10.5"}) {
    EXPECT_EQ(secondsText(*parseSeconds(text)), text);
  }
}

}  // namespace
}  // namespace slamscope::slam
