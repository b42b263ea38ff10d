// SPDX-License-Identifier: MIT
#include "apps/lib/slam_feed.hpp"

#include "apps/lib/drawable_run.hpp"
#include "apps/lib/run_truth.hpp"
#include "slam/laser_lab.hpp"
#include "slam/live_link.hpp"
#include "slam/replay.hpp"

namespace slamscope::apps {
namespace {

using std::chrono::nanoseconds;

class RecordedFeed : public SlamFeed {
 public:
  explicit RecordedFeed(const std::string& path)
      : replay_(openDrawable(path)), start_(replay_.nextTime()) {
    if (!start_) throw std::runtime_error(path + ": the run has no records");
  }
  slam::Subject& subject() override { return replay_; }
  void advanceTo(nanoseconds time) override {
    replay_.advanceTo(time);
    ended_ = !replay_.nextTime().has_value();
  }
  std::optional<nanoseconds> start() const override { return start_; }
  bool ended() const override { return ended_; }
  const slam::RunHeader& header() const override { return replay_.reader().header(); }

 private:
  slam::Replay replay_;
  std::optional<nanoseconds> start_;
  bool ended_ = false;
};

class SimulatedFeed : public SlamFeed {
 public:
  explicit SimulatedFeed(const slam::SimulationOptions& options)
      : simulation_(options), header_(simulation_.header()) {}
  slam::Subject& subject() override { return simulation_.filter(); }
  void advanceTo(nanoseconds time) override {
    while (!ended_ && next_ <= time) {
      ended_ = !simulation_.step();
      next_ += simulation_.timeStep();
    }
  }
  std::optional<nanoseconds> start() const override { return nanoseconds{0}; }
  bool ended() const override { return ended_; }
  const slam::RunHeader& header() const override { return header_; }

 private:
  slam::Simulation simulation_;
  slam::RunHeader header_;
  nanoseconds next_{0};
  bool ended_ = false;
};

class LaserLabFeed : public SlamFeed {
 public:
  explicit LaserLabFeed(const slam::LaserLab& lab)
      : run_(lab.record(), lab.runOptions()), header_(run_.header()) {}
  slam::Subject& subject() override { return run_.filter(); }
  void advanceTo(nanoseconds time) override {
    for (auto next = run_.nextTime(); next && *next <= time; next = run_.nextTime()) run_.step();
  }
  std::optional<nanoseconds> start() const override { return run_.recording().start(); }
  bool ended() const override { return !run_.nextTime().has_value(); }
  const slam::RunHeader& header() const override { return header_; }

 private:
  slam::RecordingRun run_;
  slam::RunHeader header_;
};

class LinkFeed : public SlamFeed {
 public:
  explicit LinkFeed(const std::string& spec) : link_(spec), spec_(spec) {
    if (link_.port() != 0) spec_ = "port " + std::to_string(link_.port());
  }
  slam::Subject& subject() override { return link_; }
  void advanceTo(nanoseconds) override { link_.poll(std::chrono::milliseconds(0)); }
  std::optional<nanoseconds> start() const override { return std::nullopt; }
  bool ended() const override { return link_.status().state == slam::LinkStatus::State::ended; }
  std::uint64_t runs() const override { return link_.status().runs; }
  const slam::RunHeader& header() const override { return link_.status().header; }
  std::string status() const override {
    const slam::LinkStatus& status = link_.status();
    std::string text = spec_ == "-" ? "standard input" : spec_;
    switch (status.state) {
      case slam::LinkStatus::State::waiting:
        text +=
            status.connections == 0 ? ": waiting for a filter" : ": the filter is gone, waiting";
        break;
      case slam::LinkStatus::State::connected:
        text += ": live";
        break;
      case slam::LinkStatus::State::ended:
        text += ": ended";
        break;
    }
    if (status.unreadable > 0) {
      text += ", " + std::to_string(status.unreadable) + " unreadable lines (" + status.last_error +
              ")";
    }
    return text;
  }

 private:
  slam::LiveLink link_;
  std::string spec_;
};

}  // namespace

std::unique_ptr<SlamFeed> openSlamFeed(const std::string& spec,
                                       const slam::SimulationOptions& simulation) {
  if (spec == "simulate") return std::make_unique<SimulatedFeed>(simulation);
  if (spec == "laser-lab") return std::make_unique<LaserLabFeed>(laserLabOf(simulation));
  if (spec == "-" || spec.starts_with("tcp://")) return std::make_unique<LinkFeed>(spec);
  return std::make_unique<RecordedFeed>(spec);
}

}  // namespace slamscope::apps
