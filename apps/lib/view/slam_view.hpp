// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "apps/lib/slam_feed.hpp"
#include "apps/lib/view/path_trace.hpp"
#include "slam/clusters.hpp"

namespace slamscope::apps {

/// What a viewer keeps of a feed: the newest snapshot, the path so far, the clusters. It stops at
/// the first broken snapshot (keeping the last sound one) until the source begins anew.
class SlamView {
 public:
  /// `cut`: distance (m) of the clusters; automatic where absent.
  SlamView(SlamFeed& feed, std::optional<double> cut);

  /// Takes what is due at `time` of the run.
  void advanceTo(std::chrono::nanoseconds time);

  [[nodiscard]] const slam::SnapshotPtr& newest() const { return newest_; }
  [[nodiscard]] const PathTrace& path() const { return path_; }
  /// Of the newest snapshot.
  [[nodiscard]] const slam::Clustering& clusters() const { return clusters_.current(); }
  /// How long the clusters have been as they are, in shown frames: to announce a re-partition.
  [[nodiscard]] int framesSinceRepartition() const { return frames_since_repartition_; }
  /// "record 412 (t = 6.100 s): the covariance is indefinite", once stopped.
  [[nodiscard]] const std::optional<std::string>& stopped() const { return stopped_; }
  /// Time since the newest snapshot of a live filter arrived.
  [[nodiscard]] std::chrono::nanoseconds sinceArrival() const {
    return std::chrono::steady_clock::now() - arrival_;
  }

 private:
  void take(const slam::SnapshotPtr& snapshot);
  void restart();

  SlamFeed& feed_;
  std::optional<double> cut_;
  slam::ClusterTracker clusters_;
  PathTrace path_;
  slam::SnapshotPtr newest_;
  slam::SnapshotPtr clustered_;
  std::optional<std::string> stopped_;
  std::uint64_t run_ = 0;
  int frames_since_repartition_ = 1 << 20;
  std::chrono::steady_clock::time_point arrival_{};
  slam::Subscription subscription_;
};

}  // namespace slamscope::apps
