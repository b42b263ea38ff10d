// SPDX-License-Identifier: MIT
#include "slam/live_link.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "slam/jsonl.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

const std::string kLinkHeader = "{\"format\": \"slamscope\", \"version\": 1, \"robot\": \"r\"}\n";

std::string recordAt(int time, Event event = Event::step) {
  Snapshot snapshot;
  snapshot.time = std::chrono::seconds(time);
  snapshot.event = event;
  snapshot.covariance = PackedCovariance(3);
  return formatRecord(snapshot) + "\n";
}

/// The end of a pipe or connection that a filter writes to.
class Writer {
 public:
  explicit Writer(int descriptor) : descriptor_(descriptor) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { close(); }
  void write(std::string_view text) const {
    ASSERT_EQ(::write(descriptor_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_;
};

int connectTo(int port) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  return descriptor;
}

struct Pipe {
  Pipe() { EXPECT_EQ(::pipe(ends.data()), 0); }
  ~Pipe() { ::close(ends[0]); }
  std::array<int, 2> ends{};
};

/// Keeps the times that a link published, in s.
struct Times {
  explicit Times(LiveLink& link)
      : subscription(link.observe(
            [this](const SnapshotPtr& snapshot) { seen.push_back(snapshot->time / 1s); })) {}
  std::vector<std::int64_t> seen;
  Subscription subscription;
};

/// Polls until nothing more comes; loopback delivers within the wait.
void drainLink(LiveLink& link) {
  for (int quiet = 0; quiet < 2;) quiet = link.poll(20ms) == 0 ? quiet + 1 : 0;
}

using Seconds = std::vector<std::int64_t>;

TEST(LiveLink, PublishesEveryCompleteLineOfAStreamInOrder) {
  Pipe pipe;
  Writer writer(pipe.ends[1]);
  LiveLink link(pipe.ends[0]);
  Times times(link);
  EXPECT_EQ(link.poll(0ms), 0U);
  EXPECT_EQ(link.status().state, LinkStatus::State::waiting);
  writer.write(kLinkHeader + recordAt(1) + recordAt(2) + recordAt(3).substr(0, 20));
  EXPECT_EQ(link.poll(1s), 2U);
  EXPECT_EQ(link.status().state, LinkStatus::State::connected);
  EXPECT_EQ(link.status().header.robot, "r");
  writer.write(recordAt(3).substr(20));
  EXPECT_EQ(link.poll(1s), 1U);
  std::string last = recordAt(4);
  last.pop_back();
  writer.write(last);
  writer.close();
  drainLink(link);
  EXPECT_EQ(times.seen, (Seconds{1, 2, 3, 4}));
  EXPECT_EQ(link.status().state, LinkStatus::State::ended);
  EXPECT_EQ(link.status().records, 4U);
  EXPECT_EQ(link.status().unreadable, 0U);
  EXPECT_EQ(link.poll(0ms), 0U);
}

TEST(LiveLink, SkipsAndCountsUnreadableLinesAndStaysAlive) {
  Pipe pipe;
  Writer writer(pipe.ends[1]);
  LiveLink link(pipe.ends[0]);
  Times times(link);
  writer.write(kLinkHeader + recordAt(5) + "Traceback: oops\n" + recordAt(6) + recordAt(4) +
               recordAt(7));
  drainLink(link);
  EXPECT_EQ(times.seen, (Seconds{5, 6, 7}));
  EXPECT_EQ(link.status().unreadable, 2U);
  EXPECT_EQ(link.status().last_error,
            "stream:5: time: expected at least 6 s as in the record before, found 4 s");
}

TEST(LiveLink, JoinedInTheMiddleOfALineReadsFromTheNextOn) {
  Pipe pipe;
  Writer writer(pipe.ends[1]);
  LiveLink link(pipe.ends[0]);
  Times times(link);
  writer.write(recordAt(1).substr(30) + recordAt(2));
  drainLink(link);
  EXPECT_EQ(times.seen, (Seconds{2}));
  EXPECT_EQ(link.status().unreadable, 0U);
}

TEST(LiveLink, AHeaderOrAnInitialRecordInAStreamBeginsANewRun) {
  Pipe pipe;
  Writer writer(pipe.ends[1]);
  LiveLink link(pipe.ends[0]);
  Times times(link);
  writer.write(kLinkHeader + recordAt(8) + kLinkHeader + recordAt(1) + recordAt(2) +
               recordAt(0, Event::initial));
  drainLink(link);
  EXPECT_EQ(times.seen, (Seconds{8, 1, 2, 0}));
  EXPECT_EQ(link.status().runs, 3U);
  EXPECT_EQ(link.status().unreadable, 0U);
}

TEST(LiveLink, ASourceThatDiesMayComeBack) {
  LiveLink link("tcp://127.0.0.1:0");
  Times times(link);
  EXPECT_GT(link.port(), 0);
  EXPECT_EQ(link.status().state, LinkStatus::State::waiting);
  {
    Writer writer(connectTo(link.port()));
    writer.write(kLinkHeader + recordAt(8) + recordAt(9).substr(0, 20));
    drainLink(link);
    EXPECT_EQ(link.status().state, LinkStatus::State::connected);
  }
  drainLink(link);
  EXPECT_EQ(link.status().state, LinkStatus::State::waiting);
  EXPECT_EQ(link.status().unreadable, 1U) << "the line it died in";
  Writer again(connectTo(link.port()));
  again.write(kLinkHeader + recordAt(1));
  drainLink(link);
  EXPECT_EQ(link.status().state, LinkStatus::State::connected);
  EXPECT_EQ(times.seen, (Seconds{8, 1}));
  EXPECT_EQ(link.status().connections, 2U);
  EXPECT_EQ(link.status().runs, 2U);
}

TEST(LiveLink, TheNewestConnectionThatSendsSomethingWins) {
  LiveLink link("tcp://:0");
  Times times(link);
  Writer first(connectTo(link.port()));
  first.write(recordAt(1));
  drainLink(link);
  Writer silent(connectTo(link.port()));
  drainLink(link);
  first.write(recordAt(2));
  drainLink(link);
  EXPECT_EQ(times.seen, (Seconds{1, 2})) << "a silent connection changes nothing";
  silent.write(recordAt(0));
  drainLink(link);
  EXPECT_EQ(times.seen, (Seconds{1, 2, 0}));
  EXPECT_EQ(link.status().connections, 2U);
}

TEST(LiveLink, PublishesALotWithinAFewPolls) {
  LiveLink link("tcp://0");
  Times times(link);
  Writer writer(connectTo(link.port()));
  std::string text;
  for (int k = 0; k < 100; ++k) text += recordAt(k);
  for (int round = 0; round < 10; ++round) {
    writer.write(kLinkHeader + text);
    drainLink(link);
  }
  EXPECT_EQ(times.seen.size(), 1000U);
  EXPECT_EQ(link.status().runs, 10U);
}

TEST(LiveLink, RefusesASourceItDoesNotKnowOrCantHave) {
  EXPECT_THROW(LiveLink("http://localhost:80"), std::runtime_error);
  EXPECT_THROW(LiveLink("tcp://127.0.0.1:70000"), std::runtime_error);
  EXPECT_THROW(LiveLink("tcp://127.0.0.1:ten"), std::runtime_error);
  EXPECT_THROW(LiveLink("tcp://127.0.0.1"), std::runtime_error);
  const LiveLink link("tcp://127.0.0.1:0");
  EXPECT_THROW(LiveLink("tcp://127.0.0.1:" + std::to_string(link.port())), std::runtime_error);
}

}  // namespace
}  // namespace slamscope::slam
