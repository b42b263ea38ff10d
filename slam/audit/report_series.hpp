// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <bitset>
#include <cstdint>
#include <map>
#include <vector>

#include "slam/audit/audit.hpp"
#include "slam/clusters.hpp"

namespace slamscope::slam {

/// All pairs between two clusters, or within the map where it is one cluster (a == b): √det (m²) of
/// the least, the matrix mean and the greatest P_d.
struct ClusterSizes {
  int a = 0;  ///< clusters, as in SeriesRecord::cluster
  int b = 0;
  float least = 0.0F;
  float mean = 0.0F;
  float greatest = 0.0F;
};

/// What is summed over the records since the kept one before, the kept one included.
struct SeriesStretch {
  std::uint64_t records = 0;
  double nis = 0.0;
  int dof = 0;
  std::bitset<kLawCount> broken;
  std::vector<FeatureId> blamed;  ///< by id, at most ReportSeries::kMostFeatures

  void add(const SeriesStretch& other);
};

/// A record that was kept for the plots.
struct SeriesRecord {
  std::uint64_t judged = 0;  ///< records judged up to here
  std::uint64_t record = 0;  ///< Snapshot::sequence
  double time_s = 0.0;
  Event event = Event::step;
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();      ///< x, y (m), θ (rad)
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();  ///< m², m², rad²
  int feature_count = 0;
  bool observed_given = false;
  std::size_t observed_count = 0;
  std::vector<FeatureId> observed;  ///< the first kMostFeatures of them
  SeriesStretch stretch;

  std::vector<FeatureId> ids;  ///< features of the matrix, in state order
  std::vector<int> cluster;    ///< of each of them; empty where unknown
  /// Lower triangle, packed by rows, of √det (m²) of P_d; on the diagonal of P_ii. NaN where not
  /// finite, −1 where P_d is not positive. Off-diagonal NaN where only the diagonal was logged.
  std::vector<float> sizes;
  std::vector<ClusterSizes> clusters;
  bool pinned = false;  ///< kept for what happened in it
};

/// Keeps some records of a run for its plots, in memory that does not grow with the run: every
/// stride-th one, the stride doubling whenever there are more than kMostRecords, besides those
/// where a law was first broken, the one before each, and the newest. Of a large map each has the
/// features that were blamed and the largest others.
///
///   ReportSeries series;
///   while (…) { audit.take(snapshot); series.take(snapshot, audit.lastRecord()); }
class ReportSeries {
 public:
  static constexpr std::size_t kMostRecords = 512;
  static constexpr std::size_t kMostFeatures = 60;
  static constexpr std::size_t kMostClusterPairs = 6;

  /// A record that the audit has just taken. What it passed over is passed over here.
  void take(const SnapshotPtr& snapshot, const RecordFindings& findings);

  /// In order of time, the newest record last.
  [[nodiscard]] std::vector<SeriesRecord> records() const;
  [[nodiscard]] bool diagonalOnly() const { return last_ && last_->diagonal_only; }

 private:
  void keepBefore();
  void keepLast(bool pinned);
  void thin();
  [[nodiscard]] std::vector<int> chosenFeatures(const Snapshot& snapshot) const;
  void lookAtClusters(const Snapshot& snapshot, SeriesRecord& record,
                      const std::vector<int>& chosen);

  std::vector<SeriesRecord> kept_;
  std::size_t unpinned_ = 0;
  std::uint64_t stride_ = 1;
  SnapshotPtr last_;
  std::uint64_t last_judged_ = 0;
  SeriesStretch pending_;  ///< since the newest of kept_, up to last_
  std::bitset<kLawCount> broken_;
  std::map<FeatureId, std::uint64_t> blamed_;  ///< and in how many records
  ClusterTracker tracker_;
};

}  // namespace slamscope::slam
