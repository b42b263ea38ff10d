// SPDX-License-Identifier: MIT
#include "apps/lib/audit_watch.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "apps/lib/view/alarm_lines.hpp"
#include "slam/recorder.hpp"

namespace slamscope::apps {
namespace {

using std::chrono::milliseconds;

/// Plays a feed, 30 frames a second, on one thread; the judgement after each frame.
std::vector<Judgement> play(SlamFeed& feed, std::launch where = std::launch::deferred) {
  AuditWatch watch(feed, {}, where);
  std::vector<Judgement> judgements;
  for (milliseconds time{0}; !feed.ended(); time += milliseconds(33)) {
    feed.advanceTo(time);
    watch.settle();
    judgements.push_back(watch.newest());
  }
  return judgements;
}

std::vector<Judgement> simulated(const std::string& fault,
                                 std::launch where = std::launch::deferred) {
  const auto feed = openSlamFeed("simulate", {.loops = 1, .fault = fault});
  return play(*feed, where);
}

std::vector<std::string> text(const std::vector<AlarmLine>& lines) {
  std::vector<std::string> all;
  for (const AlarmLine& line : lines) all.push_back(line.text);
  return all;
}

TEST(AuditWatch, HealthyFilterRaisesNoAlarm) {
  for (const Judgement& judgement : simulated("none")) {
    EXPECT_TRUE(judgement.flagged().empty());
    EXPECT_TRUE(judgement.broken.empty());
    EXPECT_TRUE(judgement.alarms.pairs.empty());
  }
}

TEST(AuditWatch, PaperFaultFlagsItsFeaturesFromTheRecordWhereItBegins) {
  const auto feed = openSlamFeed("simulate", {.loops = 1, .fault = "paper"});
  // Feature 2 is seen from the start, so its covariance is spoilt in the first update of all.
  std::optional<slam::Snapshot> first_update;
  const slam::Subscription subscription =
      feed->subject().observe([&](const slam::SnapshotPtr& snapshot) {
        if (!first_update && snapshot->event == slam::Event::update) first_update = *snapshot;
      });
  const std::vector<Judgement> judgements = play(*feed);
  for (const Judgement& judgement : judgements) {
    const bool begun = first_update && judgement.record >= first_update->sequence;
    EXPECT_EQ(!judgement.flagged().empty(), begun) << "record " << judgement.record;
  }
  const Judgement& end = judgements.back();
  EXPECT_EQ(end.flagged(), (std::vector<slam::FeatureId>{2, 8, 14}));
  EXPECT_TRUE(end.code_fault);
  ASSERT_FALSE(end.broken.empty());
  EXPECT_EQ(end.broken.front().law, slam::Law::shrink);
  EXPECT_EQ(end.broken.front().first_record, first_update->sequence);
}

TEST(AuditWatch, AnotherThreadJudgesTheSame) {
  const std::vector<Judgement> here = simulated("paper");
  const std::vector<Judgement> there = simulated("paper", std::launch::async);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_EQ(here[k].record, there[k].record);
    EXPECT_EQ(here[k].flagged(), there[k].flagged());
    EXPECT_EQ(here[k].broken.size(), there[k].broken.size());
  }
}

TEST(AuditWatch, AdvanceWaitsForNothingAndSettleForAll) {
  const auto feed = openSlamFeed("simulate", {.loops = 1, .fault = "paper"});
  AuditWatch watch(*feed, {});
  std::uint64_t heard = 0;
  const slam::Subscription subscription =
      feed->subject().observe([&](const slam::SnapshotPtr&) { ++heard; });
  for (milliseconds time{0}; !feed->ended(); time += milliseconds(500)) {
    feed->advanceTo(time);
    watch.advance();
    EXPECT_LE(watch.newest().records, heard);
  }
  watch.settle();
  EXPECT_EQ(watch.newest().records, heard);
}

TEST(AuditWatch, MovedFeatureIsFlaggedByItsInnovationsAlone) {
  const auto feed = openSlamFeed("simulate", {.fault = "moved-feature", .fault_features = {8}});
  const Judgement end = play(*feed).back();
  EXPECT_EQ(end.flagged(), (std::vector<slam::FeatureId>{8}));
  EXPECT_FALSE(end.code_fault);
  EXPECT_TRUE(end.alarms.pairs.empty());
}

TEST(AuditWatch, RecordsOfWholeStepsWillDo) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("slamscope-steps-" + std::to_string(getpid()) + ".jsonl");
  slam::Simulation simulation({.loops = 1, .fault = "paper"});
  slam::Recorder recorder(simulation.filter(), file.string(), simulation.header());
  while (simulation.step()) {
  }
  recorder.finish();
  const auto feed = openSlamFeed(file.string(), {});
  const Judgement end = play(*feed).back();
  std::filesystem::remove(file);
  EXPECT_EQ(end.flagged(), (std::vector<slam::FeatureId>{2, 8, 14}));
}

/// A feed that begins anew when told.
class TwoRuns : public SlamFeed, public slam::Subject {
 public:
  slam::Subject& subject() override { return *this; }
  void advanceTo(std::chrono::nanoseconds) override {}
  std::optional<std::chrono::nanoseconds> start() const override { return {}; }
  bool ended() const override { return false; }
  std::uint64_t runs() const override { return runs_; }
  const slam::RunHeader& header() const override { return header_; }

  void play(const std::string& fault) {
    ++runs_;
    slam::Simulation simulation({.loops = 1, .fault = fault});
    header_ = simulation.header();
    const slam::Subscription subscription = simulation.filter().slam::Subject::observe(
        [this](const slam::SnapshotPtr& snapshot) { publish(snapshot); });
    while (simulation.step()) {
    }
  }

 private:
  std::uint64_t runs_ = 0;
  slam::RunHeader header_;
};

TEST(AuditWatch, NewRunIsJudgedAnew) {
  TwoRuns feed;
  AuditWatch watch(feed, {}, std::launch::deferred);
  feed.play("paper");
  watch.settle();
  const std::uint64_t records = watch.newest().records;
  EXPECT_FALSE(watch.newest().flagged().empty());
  feed.play("none");
  watch.settle();
  EXPECT_TRUE(watch.newest().flagged().empty());
  EXPECT_TRUE(watch.newest().broken.empty());
  EXPECT_EQ(watch.newest().records, records);
}

TEST(AlarmLines, SayLawFeatureAndTime) {
  const Judgement end = simulated("paper").back();
  const std::vector<std::string> lines = text(alarmLines(end, end.time, false));
  ASSERT_GE(lines.size(), 2U);
  EXPECT_EQ(lines[0], "CODE FAULT: shrink · from t 0.10 s, record 8 · features 2, 8, 14");
  EXPECT_NE(lines[1].find("grows by"), std::string::npos);
  EXPECT_TRUE(alarmLines(end, end.time, false).front().alarm);
}

TEST(AlarmLines, HealthyFilterGetsALineWhereAsked) {
  const Judgement end = simulated("none").back();
  EXPECT_TRUE(alarmLines(end, end.time, false).empty());
  const std::vector<AlarmLine> lines = alarmLines(end, end.time, true);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].text.find("no law is broken"), std::string::npos);
  EXPECT_FALSE(lines[0].alarm);
}

TEST(AlarmLines, LateAuditIsSaid) {
  const Judgement end = simulated("none").back();
  const std::vector<std::string> lines =
      text(alarmLines(end, end.time + milliseconds(1500), false));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], "the audit is 1.5 s behind");
}

}  // namespace
}  // namespace slamscope::apps
