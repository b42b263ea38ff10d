// SPDX-License-Identifier: MIT
#include "slam/jsonl.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace slamscope::slam {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Every number of the two is the same to the bit (the comparator of the round trips).
bool sameNumbers(const Snapshot& a, const Snapshot& b) {
  const auto same = [](const auto& left, const auto& right) {
    return std::equal(left.begin(), left.end(), right.begin(), right.end(), sameBits);
  };
  if (a.time != b.time || a.sequence != b.sequence || a.ids != b.ids) return false;
  if (!same(a.pose, b.pose) || a.features.size() != b.features.size()) return false;
  for (std::size_t k = 0; k < a.features.size(); ++k) {
    if (!same(a.features[k], b.features[k])) return false;
  }
  return same(a.covariance.packed(), b.covariance.packed());
}

Snapshot oddSnapshot() {
  Snapshot snapshot;
  snapshot.time = std::chrono::nanoseconds(1248444187156000001);
  snapshot.sequence = std::numeric_limits<std::uint64_t>::max();
  snapshot.event = Event::initialise;
  snapshot.pose = {0.1 + 0.2, -0.0, 5e-324};
  snapshot.ids = {7, std::numeric_limits<std::uint64_t>::max()};
  snapshot.features = {{std::numeric_limits<double>::max(), -kInfinity}, {1.0 / 3.0, 1e-310}};
  snapshot.extra = {"speed \"v\"\n"};
  snapshot.covariance = PackedCovariance(8);
  for (int row = 0; row < 8; ++row) {
    for (int col = 0; col <= row; ++col) snapshot.covariance(row, col) = std::exp(row - 3.7 * col);
  }
  snapshot.covariance(3, 1) = std::numeric_limits<double>::quiet_NaN();
  return snapshot;
}

Snapshot parse(std::string_view line) {
  return LineParser().record(line, 42);
}

std::string errorOf(std::string_view line) {
  try {
    (void)parse(line);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

std::string record(const std::string& fields) {
  return R"({"time_s": 0.1, "pose": [1, 2, 3], )" + fields + "}";
}

const std::string kNoFeatures = R"("covariance_diagonal": [1, 2, 3])";

TEST(JsonLines, ReadBackToTheSameBits) {
  const Snapshot written = oddSnapshot();
  const Snapshot read = parse(formatRecord(written));
  EXPECT_TRUE(sameNumbers(written, read));
  EXPECT_EQ(read.event, Event::initialise);
  EXPECT_EQ(read.extra, written.extra);
  EXPECT_FALSE(read.asymmetry);
  EXPECT_FALSE(read.observed_given);
}

TEST(JsonLines, RoundTripComparatorRejectsALostSignOfZeroAndALostDigit) {
  const Snapshot written = oddSnapshot();
  Snapshot other = written;
  other.pose.y() = 0.0;
  EXPECT_FALSE(sameNumbers(written, other));
  other = written;
  other.covariance(7, 0) = std::nextafter(other.covariance(7, 0), 0.0);
  EXPECT_FALSE(sameNumbers(written, other));
}

TEST(JsonLines, KeepEverythingOptional) {
  Snapshot written = oddSnapshot();
  written.observed = {7};
  written.tentative = {7};
  written.observed_given = true;
  written.control = Eigen::Vector2d(0.3, -0.1);
  written.Q = Eigen::Matrix3d(Eigen::Vector3d(1e-4, 2e-4, 3e-4).asDiagonal());
  written.truth = Truth{{1, 2, 3}, {7}, {{0.5, 0.25}}};
  ObservationRecord observation;
  observation.id = 7;
  observation.z = {1, 2};
  observation.innovation = {-0.1, 0.2};
  observation.S << 2, 1, 1, 3;
  observation.R << 1, 0.5, 0.5, 1;
  observation.H = Eigen::MatrixXd::Random(2, 8);
  written.observations = {observation};
  const Snapshot read = parse(formatRecord(written));
  EXPECT_TRUE(read.observed_given);
  EXPECT_EQ(read.observed, written.observed);
  EXPECT_EQ(read.tentative, written.tentative);
  EXPECT_EQ(*read.control, *written.control);
  EXPECT_EQ(*read.Q, *written.Q);
  EXPECT_EQ(read.truth->pose, written.truth->pose);
  EXPECT_EQ(read.truth->features, written.truth->features);
  ASSERT_EQ(read.observations.size(), 1U);
  EXPECT_EQ(read.observations[0].z, observation.z);
  EXPECT_EQ(read.observations[0].innovation, observation.innovation);
  EXPECT_EQ(read.observations[0].S, observation.S);
  EXPECT_EQ(read.observations[0].R, observation.R);
  EXPECT_EQ(read.observations[0].H, observation.H);
}

TEST(JsonLines, KeepTheHeader) {
  RunHeader header;
  header.sensor = Sensor::range_bearing;
  header.robot = "blue \\ one";
  header.R = Eigen::Matrix2d(Eigen::Vector2d(0.0625, 0.0025).asDiagonal());
  header.Q = Eigen::Matrix3d::Identity();
  const auto read = LineParser().header(formatHeader(header));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sensor, Sensor::range_bearing);
  EXPECT_EQ(read->robot, header.robot);
  EXPECT_EQ(*read->R, *header.R);
  EXPECT_EQ(*read->Q, *header.Q);
}

TEST(JsonLines, AHeaderMayHaveItsFieldsInAnyOrderAndMore) {
  const auto read = LineParser().header(
      R"({"sensor": "relative-position", "made_by": [1, {"x": 2}], "version": 1.0, "format": "slamscope"})");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sensor, Sensor::relative_position);
  EXPECT_FALSE(LineParser().header(record(kNoFeatures)));
}

TEST(JsonLines, AForeignHeaderIsUnreadable) {
  const auto error = [](std::string_view line) -> std::string {
    try {
      (void)LineParser().header(line);
    } catch (const std::runtime_error& failure) {
      return failure.what();
    }
    return "no error";
  };
  EXPECT_EQ(error(R"({"format": "other", "version": 1})"),
            "format: expected \"slamscope\", found \"other\"");
  EXPECT_EQ(error(R"({"format": "slamscope", "version": 2})"),
            "version: expected 1, the only version this program reads, found 2");
  EXPECT_EQ(error(R"({"format": "slamscope", "sensor": "lidar"})"),
            "sensor: expected one of unknown range-bearing relative-position, found \"lidar\"");
  EXPECT_EQ(error(R"({"format": "slamscope", "sensor": "unknown"})"), "no error");
}

TEST(JsonLines, TimeIsSecondsOrNanoseconds) {
  const auto time = [](const std::string& field) {
    return parse("{" + field + R"(, "pose": [0, 0, 0], "covariance_diagonal": [1, 1, 1]})")
        .time.count();
  };
  EXPECT_EQ(time(R"("time_s": 0.1)"), 100'000'000);
  EXPECT_EQ(time(R"("time_s": 1248444187.156)"), 1248444187156000000);
  EXPECT_EQ(time(R"("time_s": -2)"), -2'000'000'000);
  EXPECT_EQ(time(R"("time_s": 1.5e-3)"), 1'500'000);
  EXPECT_EQ(time(R"("time_s": 0.30000000000000004)"), 300'000'000);
  EXPECT_EQ(time(R"("stamp_ns": 1248444187156000001)"), 1248444187156000001);
  EXPECT_EQ(time(R"("stamp_ns": "1248444187156000001")"), 1248444187156000001);
  EXPECT_EQ(time(R"("stamp_ns": 1e3)"), 1000);
  EXPECT_EQ(time(R"("time_s": 5, "stamp_ns": 7)"), 7);
  EXPECT_EQ(time(R"("stamp_ns": 7, "time_s": 5)"), 7);
}

TEST(JsonLines, DefaultsAreStepAndTheLinesCount) {
  const Snapshot read = parse(record(kNoFeatures));
  EXPECT_EQ(read.event, Event::step);
  EXPECT_EQ(read.sequence, 42U);
  EXPECT_EQ(parse(record(R"("event": null, "sequence": 9, )" + kNoFeatures)).sequence, 9U);
}

TEST(JsonLines, OneFeatureMayBeAScalarFlatOrNested) {
  const std::string covariance =
      R"("covariance": [[1,0,0,0,0],[0,1,0,0,0],[0,0,1,0,0],[0,0,0,1,0],[0,0,0,0,1]], )";
  for (const std::string fields :
       {R"("ids": 4, "features": [1.5, 0.5])", R"("ids": [4], "features": [[1.5, 0.5]])",
        R"("ids": [[4]], "features": [[1.5], [0.5]])", R"("ids": 4.0, "features": [1.5, 0.5])"}) {
    const Snapshot read = parse(record(covariance + fields));
    ASSERT_EQ(read.ids, std::vector<FeatureId>{4}) << fields;
    EXPECT_EQ(read.features[0], Eigen::Vector2d(1.5, 0.5)) << fields;
  }
  EXPECT_EQ(parse(record(R"("ids": [], "features": [], )" + kNoFeatures)).featureCount(), 0);
  EXPECT_EQ(parse(record(R"("ids": null, "features": null, )" + kNoFeatures)).featureCount(), 0);
}

TEST(JsonLines, TwoFeaturesMayBeFlatOrNested) {
  const std::string diagonal = R"("covariance_diagonal": [1, 1, 1, 1, 1, 1, 1], "ids": [4, 2], )";
  for (const std::string fields : {R"("features": [[1, 2], [3, 4]])", R"("features": [1, 2, 3, 4])",
                                   R"("features": [[1, 2, 3, 4]])"}) {
    const Snapshot read = parse(record(diagonal + fields));
    EXPECT_EQ(read.features[0], Eigen::Vector2d(1, 2)) << fields;
    EXPECT_EQ(read.features[1], Eigen::Vector2d(3, 4)) << fields;
  }
}

TEST(JsonLines, CovarianceMayBePackedRaggedFullOrFlat) {
  for (const std::string text :
       {"[1, 2, 3, 4, 5, 6]", "[[1], [2, 3], [4, 5, 6]]", "[[1, 2, 4], [2, 3, 5], [4, 5, 6]]",
        "[1, 2, 4, 2, 3, 5, 4, 5, 6]", "[\n\t[1,2,4] ,[2,3,5],\r[4,5,6] ]"}) {
    const Snapshot read = parse(record("\"covariance\": " + text));
    EXPECT_EQ(read.covariance(2, 1), 5.0) << text;
    EXPECT_EQ(read.covariance(2, 2), 6.0) << text;
    EXPECT_FALSE(read.diagonal_only);
  }
  EXPECT_FALSE(parse(record(R"("covariance": [1, 2, 3, 4, 5, 6])")).asymmetry);
}

TEST(JsonLines, AFullMatrixKeepsItsWorstAsymmetry) {
  const auto asymmetry = [](const std::string& text) {
    return *parse(record("\"covariance\": " + text)).asymmetry;
  };
  EXPECT_EQ(asymmetry("[[1, 2, 4], [2, 3, 5], [4, 5, 6]]"), 0.0);
  EXPECT_EQ(asymmetry("[[1, 2.5, 4], [2, 3, 5], [4, 5.25, 6]]"), 0.5);
  EXPECT_EQ(asymmetry("[[1, NaN, 4], [2, 3, 5], [4, 5, 6]]"), kInfinity);
  EXPECT_EQ(asymmetry("[[1, NaN, 4], [NaN, 3, 5], [4, 5, 6]]"), 0.0);
  const Snapshot faulty = parse(record(R"("covariance": [1, 2, 9, 2, 3, 5, 4, 5, 6])"));
  EXPECT_EQ(parse(formatRecord(faulty)).asymmetry, 5.0) << "kept where a triangle is written";
  const Snapshot lower = parse(record(R"("covariance": [[1, 2.5, 4], [2, 3, 5], [4, 5, 6]])"));
  EXPECT_EQ(lower.covariance(0, 1), 2.0) << "the lower triangle is the one that is read";
}

TEST(JsonLines, ADiagonalAloneIsMarkedAsSuch) {
  const Snapshot read = parse(record(kNoFeatures));
  EXPECT_TRUE(read.diagonal_only);
  EXPECT_EQ(read.covariance(1, 1), 2.0);
  EXPECT_EQ(read.covariance(1, 0), 0.0);
  EXPECT_TRUE(parse(formatRecord(read)).diagonal_only);
}

TEST(JsonLines, NotANumberIsReadableInEverySpelling) {
  const auto first = [](const std::string& number) {
    return parse(record(R"("covariance_diagonal": [)" + number + ", 1, 1]")).covariance(0, 0);
  };
  for (const std::string text : {"NaN", "nan", "null", "-NaN", "\"NaN\""}) {
    EXPECT_TRUE(std::isnan(first(text))) << text;
  }
  for (const std::string text : {"Infinity", "inf", "\"Infinity\"", "1e999"}) {
    EXPECT_EQ(first(text), kInfinity) << text;
  }
  EXPECT_EQ(first("-Infinity"), -kInfinity);
  EXPECT_EQ(first("1e-999"), 0.0);
  EXPECT_TRUE(std::signbit(first("-0")));
  EXPECT_TRUE(std::isnan(
      parse(record(R"("extra": "b", "covariance_diagonal": [1, 2, 3, NaN])")).covariance(3, 3)));
}

TEST(JsonLines, ScalarsStandForListsOfOne) {
  const Snapshot read = parse(record(
      R"("extra": "bias", "observed": 4, "control": 0.5, "observations": {"id": 4, "z": [1, 2]}, )"
      R"("covariance_diagonal": [1, 2, 3, 4])"));
  EXPECT_EQ(read.extra, std::vector<std::string>{"bias"});
  EXPECT_EQ(read.observed, std::vector<FeatureId>{4});
  EXPECT_EQ((*read.control)(0), 0.5);
  ASSERT_EQ(read.observations.size(), 1U);
  EXPECT_EQ(read.observations[0].z, Eigen::Vector2d(1, 2));
}

TEST(JsonLines, UnknownKeysAreIgnored) {
  EXPECT_EQ(parse(record(R"("comment": {"a": [1, "b", {"c": null}]}, )" + kNoFeatures)).pose.x(),
            1);
}

TEST(JsonLines, SayWhatIsWrongWithALine) {
  const std::string features = R"("ids": [1, 2], "features": [[1, 2], [3, 4]], )";
  EXPECT_EQ(errorOf(record(features + R"("covariance": [[1, 2, 3], [1, 2, 3]])")),
            "covariance: expected 7×7 as rows or 28 numbers packed (2 features), found 2 rows of 3 "
            "numbers");
  EXPECT_EQ(errorOf(record(features + kNoFeatures)),
            "covariance_diagonal: expected 7 numbers, found 3 numbers");
  EXPECT_EQ(errorOf(record(R"("ids": [1, 2], "features": [[1, 2]], )" + kNoFeatures)),
            "features: expected 2 pairs [x, y], as many as ids, found 1 row of 2 numbers");
  EXPECT_EQ(errorOf(record(R"("ids": [1, 1], "features": [1, 2, 3, 4], )" + kNoFeatures)),
            "ids: expected each id once, found 1 twice");
  EXPECT_EQ(errorOf(record(R"("ids": [-1], "features": [1, 2], )" + kNoFeatures)),
            "ids: expected a whole number, not negative, found -1");
  EXPECT_EQ(errorOf(record(R"("ids": ["a"], "features": [1, 2], )" + kNoFeatures)),
            "ids: expected a whole number, not negative, found \"a\"");
  EXPECT_EQ(errorOf(record(R"("covariance_diagonal": [1, "two", 3])")),
            "covariance_diagonal: expected a number, found \"two\"");
  EXPECT_EQ(errorOf(record(R"("covariance_diagonal": [1, "2", 3])")),
            "covariance_diagonal: expected a number, found \"2\"");
  EXPECT_EQ(errorOf(record(R"("covariance_diagonal": [1, true, 3])")),
            "covariance_diagonal: expected a number, found true");
  EXPECT_EQ(errorOf(record(R"("covariance": [1, [2], 3])")),
            "covariance: expected either numbers or rows of numbers, found both");
  EXPECT_EQ(
      errorOf(record(R"("event": "sleep", )" + kNoFeatures)),
      "event: expected one of initial predict update initialise remove step, found \"sleep\"");
  EXPECT_EQ(errorOf(record(R"("ids": [])")),
            "covariance: expected covariance or covariance_diagonal, found neither");
}

TEST(JsonLines, SayWhatIsMissing) {
  EXPECT_EQ(errorOf(R"({"pose": [0, 0, 0], "covariance_diagonal": [1, 1, 1]})"),
            "time_s: expected time_s or stamp_ns, found neither");
  EXPECT_EQ(errorOf(R"({"time_s": 1, "covariance_diagonal": [1, 1, 1]})"),
            "pose: expected 3 numbers, found nothing");
  EXPECT_EQ(errorOf(R"({"time_s": 1, "pose": [1, 2], "covariance_diagonal": [1, 1, 1]})"),
            "pose: expected 3 numbers, found 2 numbers");
  EXPECT_EQ(errorOf(R"({"time_s": "soon", "pose": [0, 0, 0], "covariance_diagonal": [1, 1, 1]})"),
            "time_s: expected a finite number of seconds, found \"soon\"");
  EXPECT_EQ(errorOf(R"({"time_s": NaN, "pose": [0, 0, 0], "covariance_diagonal": [1, 1, 1]})"),
            "time_s: expected a finite number of seconds, found NaN");
  EXPECT_EQ(errorOf(R"({"stamp_ns": "x", "pose": [0, 0, 0], "covariance_diagonal": [1, 1, 1]})"),
            "stamp_ns: expected a whole number, or one as text, found \"x\"");
}

TEST(JsonLines, WhatIsNoJsonObjectIsUnreadable) {
  for (const std::string line :
       {"1 2 3", "hello", "[1, 2]", "{\"time_s\": 1", "{\"time_s\" 1}", "{} {}", "\"text\"", "{",
        "{\"pose\": [1, 2}", "\xff\xfe", "{\"time_s\": 1, }", "{\"a\":\"unfinished}", "null", ""}) {
    EXPECT_NE(errorOf(line), "no error") << line;
  }
  EXPECT_EQ(errorOf(record(kNoFeatures)), "no error");
  EXPECT_EQ(errorOf(record(kNoFeatures) + record(kNoFeatures)),
            "line: expected one object a line, found more text after it");
}

TEST(JsonLines, ACutOffLineIsToldFromABrokenOne) {
  const std::string line = record(R"("extra": "a \"{ b", )" + kNoFeatures);
  EXPECT_FALSE(isCutOff(line));
  for (std::size_t size = 1; size < line.size(); ++size) {
    EXPECT_TRUE(isCutOff(line.substr(0, size))) << line.substr(0, size);
  }
  EXPECT_FALSE(isCutOff("{\"time_s\": oops}"));
}

}  // namespace
}  // namespace slamscope::slam
