// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <future>
#include <vector>

#include "apps/lib/slam_feed.hpp"
#include "slam/audit/audit.hpp"

namespace slamscope::apps {

/// What the audit says of all records up to one.
struct Judgement {
  std::uint64_t records = 0;        ///< judged so far; 0: nothing is known yet
  std::uint64_t record = 0;         ///< Snapshot::sequence of the newest of them
  std::chrono::nanoseconds time{};  ///< and its time
  slam::Alarms alarms;
  std::vector<slam::LawReport> broken;  ///< laws that are broken, the first broken first
  bool code_fault = false;              ///< an exact law is among them

  /// The features blamed by the newest record that could blame them, and those that the innovations
  /// blame in a filter whose code is whole; sorted.
  [[nodiscard]] std::vector<slam::FeatureId> flagged() const;
};

/// The audit beside a viewer. It hears every event of the feed (the picture shows the newest
/// snapshot alone) and judges on a thread of its own, at the pace of the records: the picture never
/// waits for it.
///
///   AuditWatch watch(*feed, {});
///   feed->advanceTo(time);
///   watch.advance();  // or settle()
///   draw(watch.newest());
///
/// A new run of the feed begins a new audit.
class AuditWatch {
 public:
  /// With std::launch::deferred there is no other thread: advance() judges, as settle() does.
  AuditWatch(SlamFeed& feed, slam::AuditOptions options, std::launch where = std::launch::async);
  AuditWatch(const AuditWatch&) = delete;
  AuditWatch& operator=(const AuditWatch&) = delete;

  /// Hands over what has arrived and takes what has been judged; waits for nothing.
  void advance();
  /// Waits until all that has arrived is judged.
  void settle();

  [[nodiscard]] const Judgement& newest() const { return newest_; }
  /// So much waits to be judged that a live feed should be left alone for a while. (A feed that
  /// goes on regardless is made to wait, so that neither events are lost nor the memory fills up.)
  [[nodiscard]] bool full() const { return waiting_bytes_ > kMostBytes / 2; }

  static constexpr std::size_t kMostBytes = std::size_t{256} << 20U;

 private:
  struct Arrival {
    slam::SnapshotPtr snapshot;
    std::optional<slam::RunHeader> new_run;
  };

  void hear(const slam::SnapshotPtr& snapshot);
  void start();
  /// Runs on the other thread, one at a time.
  [[nodiscard]] Judgement judge(const std::vector<Arrival>& arrivals);
  void report(Judgement& judgement);

  SlamFeed& feed_;
  slam::AuditOptions options_;
  std::launch where_;
  std::uint64_t run_ = 0;
  std::vector<Arrival> waiting_;
  std::size_t waiting_bytes_ = 0;
  Judgement newest_;

  // Touched by judge() alone.
  slam::Audit audit_;
  Judgement last_;
  std::uint64_t reported_ = 0;  ///< records at the last report
  std::size_t reported_alarms_ = 0;

  std::future<Judgement> working_;
  slam::Subscription subscription_;
};

}  // namespace slamscope::apps
