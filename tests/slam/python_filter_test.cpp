// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Dense>
#include <csignal>
#include <map>
#include <string>
#include <vector>

#include "slam/live_link.hpp"

namespace slamscope::slam {
namespace {

using namespace std::chrono_literals;

/// The true map of tests/python/ekf.py.
const std::map<FeatureId, Eigen::Vector2d> kFeatures{
    {1, {0.9, -0.1}}, {2, {1.4, 0.6}}, {3, {1.2, 1.8}}, {4, {-0.4, 2.3}}, {7, {-1.3, 1.2}}};

/// tests/python/ekf.py in a process of its own, a filter that knows nothing of us.
class PythonFilter {
 public:
  explicit PythonFilter(std::vector<std::string> arguments) {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe(ends.data()), 0);
    arguments.insert(arguments.begin(), {"python3", SLAMSCOPE_SOURCE_DIR "/tests/python/ekf.py"});
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::close(ends[0]);
      ::execvp("python3", pointers.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    output_ = ends[0];
  }
  PythonFilter(const PythonFilter&) = delete;
  PythonFilter& operator=(const PythonFilter&) = delete;
  ~PythonFilter() {
    kill();
    ::close(output_);
  }

  [[nodiscard]] int output() const { return output_; }
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
  int output_ = -1;
};

bool hasPython() {
  return std::system("python3 -c '' 2>/dev/null") == 0;
}

/// The map's squared Mahalanobis distance from the truth per degree of freedom: about 1 when the
/// filter is right about map and covariance both.
double distanceFromTruth(const Snapshot& snapshot, const Eigen::Vector2d& offset = {0.0, 0.0}) {
  const Eigen::Index n = 2 * snapshot.featureCount();
  Eigen::VectorXd error(n);
  for (int k = 0; k < snapshot.featureCount(); ++k) {
    const auto index = static_cast<std::size_t>(k);
    error.segment<2>(2 * k) = snapshot.features[index] - kFeatures.at(snapshot.ids[index]) - offset;
  }
  const Eigen::MatrixXd P = snapshot.covariance.dense().bottomRightCorner(n, n);
  return error.dot(P.llt().solve(error)) / static_cast<double>(n);
}

/// Polls until `records` have come; gives up after 20 s of silence.
void pollFor(LiveLink& link, std::uint64_t records) {
  for (int silent = 0; link.status().records < records && silent < 20;) {
    silent = link.poll(1s) == 0 ? silent + 1 : 0;
    if (link.status().state == LinkStatus::State::ended) return;
  }
}

TEST(PythonFilter, FeedsTheStreamWithACorrectMap) {
  if (!hasPython()) GTEST_SKIP() << "no python3";
  const PythonFilter filter({"--rate", "0", "--steps", "400", "--seed", "1"});
  LiveLink link(filter.output());
  SnapshotPtr last;
  const auto subscription = link.observe([&](const SnapshotPtr& snapshot) { last = snapshot; });
  pollFor(link, 401);
  ASSERT_TRUE(last);
  EXPECT_EQ(link.status().records, 400U);
  EXPECT_EQ(link.status().state, LinkStatus::State::ended);
  EXPECT_EQ(link.status().unreadable, 0U) << link.status().last_error;
  EXPECT_EQ(last->event, Event::step);
  EXPECT_GE(last->featureCount(), 3);
  EXPECT_LT(*last->asymmetry, 1e-12);
  EXPECT_LT(distanceFromTruth(*last), 4.0);
  EXPECT_GT(distanceFromTruth(*last, {0.1, 0.1}), 4.0) << "the comparator sees 0.1 m";
}

TEST(PythonFilter, MayBeKilledAndStartedAgainAndStartBeforeTheViewer) {
  if (!hasPython()) GTEST_SKIP() << "no python3";
  int port = 0;
  { port = LiveLink("tcp://127.0.0.1:0").port(); }  // free a moment ago: nobody listens there yet
  const std::string address = "127.0.0.1:" + std::to_string(port);
  PythonFilter first({"--rate", "200", "--tcp", address});
  LiveLink link("tcp://" + address);
  SnapshotPtr last;
  const auto subscription = link.observe([&](const SnapshotPtr& snapshot) { last = snapshot; });
  pollFor(link, 20);
  ASSERT_GE(link.status().records, 20U);
  const auto before = last->time;
  first.kill();
  for (int k = 0; k < 20 && link.status().state != LinkStatus::State::waiting; ++k) link.poll(1s);
  EXPECT_EQ(link.status().state, LinkStatus::State::waiting);
  const std::uint64_t records = link.status().records;
  const PythonFilter second({"--rate", "200", "--tcp", address});
  pollFor(link, records + 1);
  EXPECT_LT(last->time, before) << "its time begins again";
  pollFor(link, records + 20);
  EXPECT_GE(link.status().records, records + 20);
  EXPECT_EQ(link.status().runs, 2U);
  EXPECT_LE(link.status().unreadable, 1U) << "at most the line it died in";
}

}  // namespace
}  // namespace slamscope::slam
