// SPDX-License-Identifier: MIT
#include "apps/lib/view/slam_view.hpp"

#include <cstdio>

#include "apps/lib/view/broken_snapshot.hpp"

namespace slamscope::apps {

SlamView::SlamView(SlamFeed& feed, std::optional<double> cut)
    : feed_(feed),
      cut_(cut),
      clusters_(cut),
      run_(feed.runs()),
      subscription_(
          feed.subject().observe([this](const slam::SnapshotPtr& snapshot) { take(snapshot); })) {}

void SlamView::advanceTo(std::chrono::nanoseconds time) {
  feed_.advanceTo(time);
  ++frames_since_repartition_;
  if (!newest_ || newest_ == clustered_) return;
  // Only what is shown is clustered: a frame may take in many records.
  if (clusters_.update(*newest_).repartitioned) frames_since_repartition_ = 0;
  clustered_ = newest_;
}

void SlamView::restart() {
  clusters_ = slam::ClusterTracker(cut_);
  path_.clear();
  newest_ = clustered_ = nullptr;
  stopped_.reset();
}

void SlamView::take(const slam::SnapshotPtr& snapshot) {
  if (feed_.runs() != run_) restart();
  run_ = feed_.runs();
  if (stopped_) return;
  if (const auto why = brokenness(*snapshot)) {
    char where[64];
    std::snprintf(where, sizeof where,
                  "record %llu (t = %.3f s): ", static_cast<unsigned long long>(snapshot->sequence),
                  std::chrono::duration<double>(snapshot->time).count());
    stopped_ = where + *why;
    return;
  }
  newest_ = snapshot;
  arrival_ = std::chrono::steady_clock::now();
  path_.add(snapshot->pose.head<2>());
}

}  // namespace slamscope::apps
