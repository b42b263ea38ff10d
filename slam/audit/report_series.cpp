// SPDX-License-Identifier: MIT
#include "slam/audit/report_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "slam/correlation.hpp"
#include "slam/correlation_pairs.hpp"

namespace slamscope::slam {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// √det; NaN where not finite, −1 where not positive.
float sizeOf(const Eigen::Matrix2d& covariance) {
  if (!covariance.allFinite()) return kUnknown;
  const Eigen::Vector2d values = principalAxes(covariance).eigenvalues;
  return values[1] < 0.0 ? -1.0F : static_cast<float>(std::sqrt(values[0] * values[1]));
}

float ownSize(const Snapshot& snapshot, int i) {
  const int row = Snapshot::row(i);
  Eigen::Matrix2d P_ii = snapshot.covariance.block2(row, row);
  if (snapshot.diagonal_only) P_ii(0, 1) = P_ii(1, 0) = 0.0;
  return sizeOf(P_ii);
}

/// Every pair of a map that is one cluster.
ClusterSizes wholeMap(const Snapshot& snapshot) {
  ClusterSizes sizes;
  sizes.least = std::numeric_limits<float>::infinity();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  const int n = snapshot.featureCount();
  for (int i = 1; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      const Eigen::Matrix2d P_d = relativeCovariance(snapshot, i, j);
      const float size = sizeOf(P_d);
      sum += P_d;
      sizes.least = std::min(sizes.least, size);
      sizes.greatest = std::max(sizes.greatest, size);
    }
  }
  sizes.mean = sizeOf(sum / (0.5 * n * (n - 1)));
  return sizes;
}

SeriesRecord withoutMatrix(const Snapshot& s) {
  SeriesRecord record;
  record.record = s.sequence;
  record.time_s = 1e-9 * static_cast<double>(s.time.count());
  record.event = s.event;
  record.pose = s.pose;
  for (int k = 0; k < 3; ++k) record.variance[k] = s.covariance(k, k);
  record.feature_count = s.featureCount();
  record.observed_given = s.observed_given;
  record.observed_count = s.observed.size();
  const std::size_t most = std::min(s.observed.size(), ReportSeries::kMostFeatures);
  record.observed.assign(s.observed.begin(),
                         s.observed.begin() + static_cast<std::ptrdiff_t>(most));
  return record;
}

}  // namespace

void SeriesStretch::add(const SeriesStretch& other) {
  records += other.records;
  nis += other.nis;
  dof += other.dof;
  broken |= other.broken;
  std::set<FeatureId> all(blamed.begin(), blamed.end());
  for (const FeatureId id : other.blamed) {
    if (all.size() < ReportSeries::kMostFeatures) all.insert(id);
  }
  blamed.assign(all.begin(), all.end());
}

void ReportSeries::take(const SnapshotPtr& snapshot, const RecordFindings& findings) {
  if (findings.judged == last_judged_) return;
  SeriesStretch now{1, findings.nis, findings.dof, {}, {}};
  for (const Law law : findings.broken) now.broken.set(static_cast<std::size_t>(law));
  now.blamed.assign(findings.features.begin(),
                    findings.features.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                    findings.features.size(), kMostFeatures)));
  const bool first_break = (now.broken & ~broken_).any();
  if (first_break && last_) keepBefore();
  broken_ |= now.broken;
  for (const FeatureId id : findings.features) ++blamed_[id];

  last_ = snapshot;
  last_judged_ = findings.judged;
  pending_.add(now);
  if (first_break || (last_judged_ - 1) % stride_ == 0) keepLast(first_break);
  while (unpinned_ > kMostRecords) thin();
}

/// Keeps the newest record for good, as the last whole one.
void ReportSeries::keepBefore() {
  if (pending_.records > 0) {
    keepLast(true);
  } else if (!kept_.back().pinned) {
    kept_.back().pinned = true;
    --unpinned_;
  }
}

void ReportSeries::keepLast(bool pinned) {
  const Snapshot& s = *last_;
  SeriesRecord record = withoutMatrix(s);
  record.judged = last_judged_;
  record.pinned = pinned;
  record.stretch = std::exchange(pending_, {});
  const std::vector<int> chosen = chosenFeatures(s);
  record.sizes.reserve(chosen.size() * (chosen.size() + 1) / 2);
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    record.ids.push_back(s.ids[static_cast<std::size_t>(chosen[a])]);
    for (std::size_t b = 0; b < a; ++b) {
      record.sizes.push_back(s.diagonal_only ? kUnknown
                                             : sizeOf(relativeCovariance(s, chosen[b], chosen[a])));
    }
    record.sizes.push_back(ownSize(s, chosen[a]));
  }
  lookAtClusters(s, record, chosen);
  kept_.push_back(std::move(record));
  if (!pinned) ++unpinned_;
}

/// Those blamed most often, then the largest; one that was chosen before counts twice its size, so
/// that the choice does not flicker.
std::vector<int> ReportSeries::chosenFeatures(const Snapshot& s) const {
  const auto n = static_cast<std::size_t>(s.featureCount());
  std::vector<int> chosen(n);
  for (std::size_t i = 0; i < n; ++i) chosen[i] = static_cast<int>(i);
  if (n <= kMostFeatures) return chosen;
  std::set<FeatureId> before;
  if (!kept_.empty()) before.insert(kept_.back().ids.begin(), kept_.back().ids.end());
  std::vector<std::pair<std::uint64_t, float>> rank;
  for (std::size_t i = 0; i < n; ++i) {
    const auto blame = blamed_.find(s.ids[i]);
    const float size = ownSize(s, static_cast<int>(i));
    rank.emplace_back(blame == blamed_.end() ? 0 : blame->second,
                      size >= 0.0F ? size * (before.contains(s.ids[i]) ? 2.0F : 1.0F)
                                   : std::numeric_limits<float>::infinity());
  }
  const auto end = chosen.begin() + static_cast<std::ptrdiff_t>(kMostFeatures);
  std::partial_sort(chosen.begin(), end, chosen.end(), [&](int a, int b) {
    return rank[static_cast<std::size_t>(a)] > rank[static_cast<std::size_t>(b)];
  });
  chosen.erase(end, chosen.end());
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

void ReportSeries::lookAtClusters(const Snapshot& s, SeriesRecord& record,
                                  const std::vector<int>& chosen) {
  if (s.featureCount() < 2 || s.diagonal_only || !s.finite()) return;
  const Clustering& clusters = tracker_.update(s);
  for (const int i : chosen) {
    record.cluster.push_back(clusters.label[static_cast<std::size_t>(i)]);
  }
  if (clusters.count() == 1) {
    record.clusters.push_back(wholeMap(s));
    return;
  }
  const auto pairs = selectPairs(s, PairMode::min_mean_max, clusters).cluster_pairs;
  for (const ClusterPair& pair : pairs) {
    record.clusters.push_back(
        {pair.a, pair.b, sizeOf(pair.minimum.P_d), sizeOf(pair.mean), sizeOf(pair.maximum.P_d)});
  }
  if (pairs.size() <= kMostClusterPairs) return;
  const auto members = [&](int k) { return clusters.members[static_cast<std::size_t>(k)].size(); };
  std::stable_sort(record.clusters.begin(), record.clusters.end(),
                   [&](const auto& x, const auto& y) {
                     return members(x.a) * members(x.b) > members(y.a) * members(y.b);
                   });
  record.clusters.resize(kMostClusterPairs);
}

void ReportSeries::thin() {
  stride_ *= 2;
  std::vector<SeriesRecord> left;
  SeriesStretch carried;
  unpinned_ = 0;
  for (SeriesRecord& record : kept_) {
    carried.add(record.stretch);
    if (!record.pinned && (record.judged - 1) % stride_ != 0) continue;
    if (!record.pinned) ++unpinned_;
    record.stretch = std::exchange(carried, {});
    left.push_back(std::move(record));
  }
  carried.add(pending_);
  pending_ = std::move(carried);
  kept_ = std::move(left);
}

std::vector<SeriesRecord> ReportSeries::records() const {
  if (!last_ || pending_.records == 0) return kept_;
  ReportSeries whole = *this;
  whole.keepLast(true);
  return std::move(whole.kept_);
}

}  // namespace slamscope::slam
