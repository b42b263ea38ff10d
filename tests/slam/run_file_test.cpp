// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "slam/jsonl.hpp"
#include "slam/recorder.hpp"
#include "slam/replay.hpp"
#include "slam/run_summary.hpp"

namespace slamscope::slam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const std::string kHeader = R"({"format": "slamscope", "version": 1, "sensor": "range-bearing"})"
                            "\n";

std::string line(int time, std::vector<FeatureId> ids = {}, Event event = Event::step) {
  Snapshot snapshot;
  snapshot.time = std::chrono::seconds(time);
  snapshot.event = event;
  snapshot.ids = std::move(ids);
  snapshot.features.resize(snapshot.ids.size(), Eigen::Vector2d::Zero());
  snapshot.covariance = PackedCovariance(3 + 2 * snapshot.featureCount());
  return formatRecord(snapshot) + "\n";
}

class RunFile : public ::testing::Test {
 protected:
  RunFile() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              ("slamscope_" + std::string(info->name()) + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  ~RunFile() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  std::string store(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }
  [[nodiscard]] std::string load(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  [[nodiscard]] std::size_t filesIn() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  /// The message without the folder, or "" where the whole run can be read.
  [[nodiscard]] std::string errorOf(const std::string& text,
                                    const std::string& name = "run.jsonl") const {
    try {
      RunReader reader(store(name, text));
      while (reader.next()) {
      }
    } catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return "";
  }

  fs::path folder_;
};

std::size_t countRecords(RunReader& reader) {
  std::size_t count = 0;
  while (reader.next()) ++count;
  return count;
}

TEST_F(RunFile, IsWrittenAndReadPlainAndCompressed) {
  for (const std::string name : {"run.jsonl", "run.jsonl.zst"}) {
    RunHeader header;
    header.sensor = Sensor::relative_position;
    RunWriter writer(path(name), header);
    Snapshot snapshot;
    snapshot.covariance = PackedCovariance(3);
    for (int k = 0; k < 5000; ++k) {
      snapshot.time = std::chrono::milliseconds(k);
      snapshot.pose.x() = 0.1 * k;
      writer.write(snapshot);
    }
    writer.finish();
    RunReader reader(path(name));
    EXPECT_EQ(reader.header().sensor, Sensor::relative_position);
    for (int k = 0; k < 5000; ++k) {
      const auto read = reader.next();
      ASSERT_TRUE(read);
      ASSERT_EQ((*read)->pose.x(), 0.1 * k);
    }
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.warnings().empty());
  }
  EXPECT_TRUE(load("run.jsonl.zst").starts_with("\x28\xb5\x2f\xfd"));
  EXPECT_LT(load("run.jsonl.zst").size(), load("run.jsonl").size() / 4);
}

TEST_F(RunFile, IsNotThereBeforeItIsWhole) {
  store("run.jsonl", "the old one");
  {
    RunWriter writer(path("run.jsonl"), {});
    writer.write(Snapshot());
    EXPECT_EQ(load("run.jsonl"), "the old one");
    EXPECT_EQ(filesIn(), 2U);
  }
  EXPECT_EQ(load("run.jsonl"), "the old one");
  EXPECT_EQ(filesIn(), 1U) << "the temporary file is removed";
  RunWriter writer(path("run.jsonl"), {});
  writer.finish();
  EXPECT_TRUE(load("run.jsonl").starts_with("{\"format\""));
  EXPECT_EQ(filesIn(), 1U);
}

TEST_F(RunFile, ThatCantBeOpenedIsNamedWithTheReason) {
  const auto error = [](const std::string& name) -> std::string {
    try {
      RunReader reader(name);
    } catch (const std::runtime_error& failure) {
      return failure.what();
    }
    return "";
  };
  EXPECT_EQ(error("/nowhere/run.jsonl"),
            "/nowhere/run.jsonl: can't be opened (No such file or directory)");
  fs::create_directory(path("folder"));
  EXPECT_EQ(error(path("folder")), path("folder") +
                                       ": expected a file, or a directory of MRPT's kf-slam with "
                                       "full_cov_*.txt in it, found a directory without");
  fs::remove(path("folder"));
  const std::string odd = store("run.csv", kHeader);
  EXPECT_EQ(error(odd), odd +
                            ": .csv is not supported; runs end in .jsonl, .jsonl.zst, .npz, .npy "
                            "or .mat, or are a directory of MRPT's kf-slam");
  EXPECT_THROW(RunWriter(path("run.txt"), {}), std::runtime_error);
  EXPECT_THROW(RunWriter("/nowhere/run.jsonl", {}), std::runtime_error);
  EXPECT_EQ(filesIn(), 1U);
}

TEST_F(RunFile, MayComeWithoutHeaderWithBlankLinesAndCarriageReturns) {
  RunReader reader(store("run.jsonl", "\n" + line(1) + "\r\n" + line(2)));
  EXPECT_EQ(reader.header().sensor, Sensor::unknown);
  EXPECT_EQ((*reader.next())->sequence, 0U) << "the record read with the header is not lost";
  EXPECT_EQ((*reader.next())->time, 2s);
  EXPECT_FALSE(reader.next());
}

TEST_F(RunFile, OfZstdUnderThePlainNameIsReadByItsContent) {
  TextOutput output(path("packed.jsonl"), true);
  output.write(kHeader + line(1));
  output.finish();
  RunReader reader(path("packed.jsonl"));
  EXPECT_EQ(countRecords(reader), 1U);
}

TEST_F(RunFile, WithoutALastLineEndIsWhole) {
  std::string text = kHeader + line(1) + line(2);
  text.pop_back();
  RunReader reader(store("run.jsonl", text));
  EXPECT_EQ(countRecords(reader), 2U);
  EXPECT_TRUE(reader.warnings().empty());
}

TEST_F(RunFile, CutOffInItsLastLineIsUsedUpToThereAndSaysSo) {
  const std::string whole = kHeader + line(1) + line(2, {4});
  const std::size_t last = whole.size() - line(2, {4}).size();
  for (std::size_t size = last + 1; size < whole.size() - 1; ++size) {
    RunReader reader(store("run.jsonl", whole.substr(0, size)));
    ASSERT_EQ(countRecords(reader), 1U) << size;
    ASSERT_EQ(reader.warnings().size(), 1U) << size;
  }
  RunReader reader(store("run.jsonl", whole.substr(0, last + 20)));
  countRecords(reader);
  EXPECT_EQ(reader.warnings()[0],
            path("run.jsonl") +
                ":3: the last line is cut off after 20 bytes and was left out; 1 "
                "records before it are used");
}

TEST_F(RunFile, CutOffInTheMiddleIsUnreadable) {
  EXPECT_EQ(errorOf(kHeader + line(1).substr(0, 30) + "\n" + line(2)).substr(0, 12),
            "run.jsonl:2:");
}

TEST_F(RunFile, CutOffWhileCompressedIsUsedUpToThereAndSaysSo) {
  RunWriter writer(path("run.jsonl.zst"), {});
  Snapshot snapshot;
  snapshot.covariance = PackedCovariance(43);
  for (int k = 0; k < 2000; ++k) {
    snapshot.pose.x() = 1.0 / (1 + k);
    for (int i = 0; i < 43; ++i) snapshot.covariance(i, i) = std::sin(43.0 * k + i);
    snapshot.time = std::chrono::milliseconds(k);
    snapshot.extra.assign(40, "x");
    writer.write(snapshot);
  }
  writer.finish();
  const std::string whole = load("run.jsonl.zst");
  RunReader reader(store("cut.jsonl.zst", whole.substr(0, whole.size() * 2 / 3)));
  const std::size_t records = countRecords(reader);
  EXPECT_GT(records, 500U);
  EXPECT_LT(records, 2000U);
  EXPECT_EQ(reader.warnings().size(), 1U);

  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 0x55;
  damaged[damaged.size() / 2 + 1] ^= 0x55;
  RunReader other(store("damaged.jsonl.zst", damaged));
  EXPECT_THROW(countRecords(other), std::runtime_error);
}

TEST_F(RunFile, OfNothingIsUnreadable) {
  EXPECT_EQ(errorOf(""), "run.jsonl: expected a header and records, found an empty file");
  EXPECT_EQ(errorOf("\n\n"), "run.jsonl: expected a header and records, found an empty file");
  EXPECT_EQ(errorOf("{\"format\": \"slam"),
            "run.jsonl: expected a header and records, found nothing but a line that is cut off");
  EXPECT_EQ(errorOf(kHeader), "");
}

TEST_F(RunFile, NamesFileLineAndField) {
  EXPECT_EQ(errorOf("{\"format\": \"slamscope\", \"version\": 7}\n"),
            "run.jsonl:1: version: expected 1, the only version this program reads, found 7");
  EXPECT_EQ(errorOf(kHeader + line(1) + "{\"time_s\": 2, \"pose\": [0, 0, \"x\"]}\n"),
            "run.jsonl:3: pose: expected a number, found \"x\"");
  EXPECT_EQ(errorOf(kHeader + line(1) + kHeader + line(2)),
            "run.jsonl:3: format: expected a record, found a second header");
}

TEST_F(RunFile, TimeMayStandStillButNotGoBack) {
  EXPECT_EQ(errorOf(kHeader + line(2) + line(1)),
            "run.jsonl:3: time: expected at least 2 s as in the record before, found 1 s");
  EXPECT_EQ(errorOf(kHeader + line(2) + line(2) + line(3) + line(3)), "");
  RunReader reader(path("run.jsonl"));
  countRecords(reader);
  ASSERT_EQ(reader.warnings().size(), 1U);
  EXPECT_EQ(reader.warnings()[0],
            path("run.jsonl") + ": 2 records have the same time as the one before");
  EXPECT_EQ(errorOf(line(1, {}, Event::predict) + line(1, {}, Event::update)), "");
  RunReader events(path("run.jsonl"));
  countRecords(events);
  EXPECT_TRUE(events.warnings().empty()) << "events of one time step share their time";
}

TEST_F(RunFile, FeaturesComeAndGoWithEventsOnly) {
  const auto change = [&](std::vector<FeatureId> before, std::vector<FeatureId> after,
                          Event event) {
    return errorOf(line(1, std::move(before)) + line(2, std::move(after), event));
  };
  EXPECT_EQ(change({1, 2}, {1, 2, 3}, Event::step), "");
  EXPECT_EQ(change({1, 2}, {1, 2, 3}, Event::initialise), "");
  EXPECT_EQ(change({1, 2}, {1, 2, 3}, Event::update),
            "run.jsonl:2: ids: feature 3 appears in a record of event update, expected that of "
            "initial, initialise or step only");
  EXPECT_EQ(change({1, 2, 3}, {1, 3}, Event::remove), "");
  EXPECT_EQ(change({1, 2, 3}, {3, 2}, Event::remove), "") << "the last may fill the gap";
  EXPECT_EQ(change({1, 2, 3}, {1, 3, 4}, Event::step), "");
  EXPECT_EQ(change({1, 2, 3}, {1, 3}, Event::predict),
            "run.jsonl:2: ids: feature 2 is gone in a record of event predict, expected that of "
            "remove or step only");
  EXPECT_EQ(change({1, 2, 3}, {1, 3, 2}, Event::step),
            "run.jsonl:2: ids: expected the order of the record before, found feature 2 in another "
            "place");
  EXPECT_NE(change({1, 2}, {2, 1}, Event::update), "");
}

TEST_F(RunFile, BrokenNumbersAreReadable) {
  EXPECT_EQ(
      errorOf(R"({"time_s": 1, "pose": [1e6, NaN, null], "covariance_diagonal": [-1, Infinity, 0]})"
              "\n"),
      "");
}

class SentRun : public Subject {
 public:
  void send(Event event, int time) const {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->event = event;
    snapshot->time = std::chrono::seconds(time);
    snapshot->covariance = PackedCovariance(3);
    publish(snapshot);
  }
};

TEST_F(RunFile, RecorderWritesTheEventsAskedFor) {
  SentRun source;
  Recorder steps(source, path("steps.jsonl"), {});
  Recorder all(source, path("all.jsonl.zst"), {}, kRecordAll);
  for (const Event event : {Event::initial, Event::predict, Event::update, Event::initialise,
                            Event::remove, Event::step}) {
    source.send(event, 1);
  }
  EXPECT_EQ(steps.records(), 2U);
  EXPECT_EQ(all.records(), 5U);
  steps.finish();
  source.send(Event::step, 2);
  all.finish();
  RunReader reader(path("steps.jsonl"));
  EXPECT_EQ(countRecords(reader), 2U);
  RunReader every(path("all.jsonl.zst"));
  EXPECT_EQ(countRecords(every), 5U);
}

TEST_F(RunFile, ReplayPublishesRecordsInOrder) {
  Replay replay(RunReader(store("run.jsonl", kHeader + line(1) + line(2) + line(3) + line(9))));
  std::vector<std::int64_t> times;
  const auto subscription =
      replay.observe([&](const SnapshotPtr& snapshot) { times.push_back(snapshot->time / 1s); });
  EXPECT_EQ(replay.nextTime(), 1s);
  EXPECT_TRUE(replay.step());
  EXPECT_EQ(replay.advanceTo(3s), 2U);
  EXPECT_EQ(replay.advanceTo(8s), 0U);
  EXPECT_TRUE(replay.step());
  EXPECT_FALSE(replay.step());
  EXPECT_FALSE(replay.nextTime());
  EXPECT_EQ(times, (std::vector<std::int64_t>{1, 2, 3, 9}));
}

TEST_F(RunFile, SummaryCountsWhatIsInIt) {
  RunReader reader(store("run.jsonl", kHeader + line(1) + line(2, {7}) + line(2, {7, 8}) +
                                          line(5, {8}) + line(6, {8, 9})));
  const RunSummary summary = summarize(reader);
  EXPECT_EQ(summary.records, 5U);
  EXPECT_EQ(summary.steps, 4U);
  EXPECT_EQ(summary.count(Event::step), 5U);
  EXPECT_EQ(summary.features_at_end, 2);
  EXPECT_EQ(summary.features_at_most, 2);
  EXPECT_EQ(summary.different_features, 3U);
  EXPECT_EQ(summary.duration(), 5s);
  EXPECT_EQ(summary.header.sensor, Sensor::range_bearing);
  EXPECT_EQ(summary.levelName(), "L1");
  EXPECT_EQ(summary.warnings.size(), 1U);
  EXPECT_FALSE(summary.first_not_finite);
}

TEST_F(RunFile, LevelFollowsFromWhatWasRecorded) {
  const auto level = [&](const std::string& text) {
    RunReader reader(store("run.jsonl", text));
    return summarize(reader).levelName();
  };
  const auto with = [](std::string record, const std::string& fields) {
    return record.insert(record.size() - 2, ", " + fields);
  };
  const std::string diagonal =
      R"({"time_s": 9, "pose": [0, 0, 0], "covariance_diagonal": [1, 2, 3]})";
  const std::string no_means =
      R"({"time_s": 1, "pose": [null, null, null], "covariance": [1,2,3,4,5,6]})";
  const std::string events = line(1, {}, Event::predict) + line(1, {}, Event::update);
  EXPECT_EQ(level(no_means), "LC");
  EXPECT_EQ(level(diagonal), "L0");
  EXPECT_EQ(level(line(1)), "L1");
  EXPECT_EQ(level(line(1, {}, Event::update)), "L1") << "updates without predictions";
  EXPECT_EQ(level(events), "L2");
  EXPECT_EQ(level(events + diagonal), "L0");
  EXPECT_EQ(level(events + with(line(2, {}, Event::update),
                                R"("observations": {"id": 1, "z": [1, 2], "S": [1, 0, 1]})")),
            "L3");
  EXPECT_EQ(level(with(line(1), R"("truth": {"pose": [0, 0, 0], "ids": [], "features": []})")),
            "L1, with truth (L4)");
}

TEST_F(RunFile, SummaryNamesTheFirstRecordThatIsNotFinite) {
  const std::string broken =
      R"({"time_s": 3, "pose": [0, NaN, 0], "covariance_diagonal": [1, 2, 3]})";
  RunReader reader(store("run.jsonl", line(1) + line(2) + broken));
  EXPECT_EQ(summarize(reader).first_not_finite, 2U);
}

}  // namespace
}  // namespace slamscope::slam
