// SPDX-License-Identifier: MIT
#include "apps/lib/audit_watch.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace slamscope::apps {
namespace {

std::size_t bytesOf(const slam::Snapshot& snapshot) {
  return sizeof(slam::Snapshot) + snapshot.covariance.packed().size_bytes();
}

}  // namespace

std::vector<slam::FeatureId> Judgement::flagged() const {
  std::set<slam::FeatureId> ids;
  for (const slam::FeatureAlarm& alarm : alarms.features) {
    if (alarm.active) ids.insert(alarm.feature);
  }
  // Where code is at fault innovations are large all over the map.
  for (const slam::LawReport& law : broken) {
    if (code_fault || law.fault_class != slam::FaultClass::statistics) continue;
    for (const slam::Blame& blame : law.blame) ids.insert(blame.feature);
  }
  return {ids.begin(), ids.end()};
}

AuditWatch::AuditWatch(SlamFeed& feed, slam::AuditOptions options, std::launch where)
    : feed_(feed),
      options_(std::move(options)),
      where_(where),
      audit_(options_, feed.header()),
      subscription_(
          feed.subject().observe([this](const slam::SnapshotPtr& snapshot) { hear(snapshot); })) {}

void AuditWatch::hear(const slam::SnapshotPtr& snapshot) {
  Arrival arrival{.snapshot = snapshot, .new_run = {}};
  if (feed_.runs() != run_) {
    run_ = feed_.runs();
    arrival.new_run = feed_.header();
    waiting_.clear();  // nobody will look at the old run again
    waiting_bytes_ = 0;
  }
  waiting_.push_back(std::move(arrival));
  waiting_bytes_ += bytesOf(*snapshot);
  if (waiting_bytes_ > kMostBytes) settle();
}

void AuditWatch::start() {
  waiting_bytes_ = 0;
  working_ =
      std::async(where_, [this, batch = std::exchange(waiting_, {})] { return judge(batch); });
}

void AuditWatch::advance() {
  using std::future_status;
  if (where_ != std::launch::async) return settle();
  if (working_.valid()) {
    if (working_.wait_for(std::chrono::seconds(0)) != future_status::ready) return;
    newest_ = working_.get();
  }
  if (!waiting_.empty()) start();
}

void AuditWatch::settle() {
  if (working_.valid()) newest_ = working_.get();
  if (waiting_.empty()) return;
  start();
  newest_ = working_.get();
}

Judgement AuditWatch::judge(const std::vector<Arrival>& arrivals) {
  for (const Arrival& arrival : arrivals) {
    if (arrival.new_run) {
      audit_ = slam::Audit(options_, *arrival.new_run);
      last_ = {};
      reported_ = reported_alarms_ = 0;
    }
    audit_.take(arrival.snapshot);
    ++last_.records;
  }
  last_.record = arrivals.back().snapshot->sequence;
  last_.time = arrivals.back().snapshot->time;
  last_.alarms = audit_.alarms();
  report(last_);
  return last_;
}

/// A report looks at all of P with O(N³): it is asked for when something new is blamed, and else
/// each time the run has grown by a quarter.
void AuditWatch::report(Judgement& judgement) {
  const std::size_t alarms = judgement.alarms.broken.size() + judgement.alarms.features.size();
  if (alarms == reported_alarms_ && 4 * judgement.records < 5 * reported_) return;
  reported_ = judgement.records;
  reported_alarms_ = alarms;
  const slam::AuditReport report = audit_.report();
  judgement.code_fault = report.found(slam::FaultClass::code);
  judgement.broken.clear();
  for (const slam::LawReport& law : report.laws) {
    const bool broken = law.fault_class && report.found(*law.fault_class);
    if (broken) judgement.broken.push_back(law);
  }
  std::stable_sort(judgement.broken.begin(), judgement.broken.end(),
                   [](const slam::LawReport& a, const slam::LawReport& b) {
                     return a.first_time_s.value_or(0.0) < b.first_time_s.value_or(0.0);
                   });
}

}  // namespace slamscope::apps
