// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "slam/audit/audit_report.hpp"
#include "slam/snapshot.hpp"
#include "slam/subject.hpp"

namespace slamscope::slam {

/// Lawful variants of the filter that break a law by design (`--allow`).
enum class Allow {
  moving_features,
  absolute_sensor,
  inflation,
  robocentric,
  fej,
  frozen_linearisation,
  iterated,
  diffuse_initialisation,
};

/// `moving-features`, … The second throws std::invalid_argument that lists the words.
[[nodiscard]] std::string_view allowName(Allow allow);
[[nodiscard]] Allow allowFromName(std::string_view name);

struct AuditOptions {
  std::set<Allow> allow;
  /// Family-wise error of all statistical laws together, over the whole run. In (0, 1).
  double alpha = 1e-3;
  /// False for logs of covariances alone (level LC): means are then not looked at, not even for
  /// being finite.
  bool means_known = true;
};

/// A feature that is blamed now, for the viewer.
struct FeatureAlarm {
  FeatureId feature = 0;
  Law law = Law::finite;           ///< the first law it was blamed for
  std::uint64_t first_record = 0;  ///< Snapshot::sequence
  bool active = true;              ///< blamed by the newest transition that could have blamed it
  std::optional<Eigen::Matrix2d> last_good;  ///< its P_ii (m²) before; absent if born wrong
};

/// A pair with a blamed feature in it, a < b by id.
struct PairAlarm {
  FeatureId a = 0;
  FeatureId b = 0;
  /// P_d (m²) of equation (13) in the last record before the blame: the halo of the glyph. Absent
  /// where one of them was not in the map then.
  std::optional<Eigen::Matrix2d> last_good;
};

/// What `--mode alarms` draws: state after the newest record.
struct Alarms {
  std::vector<FeatureAlarm> features;  ///< by id
  std::vector<PairAlarm> pairs;        ///< of active features with every feature of the map
  std::vector<Law> broken;             ///< laws broken at least once so far
};

/// What the newest record alone added, for plots along the run.
struct RecordFindings {
  std::uint64_t judged = 0;         ///< records judged so far, this one included
  double nis = 0.0;                 ///< of its update, χ² with `dof` degrees of freedom
  int dof = 0;                      ///< 0 where nothing could be measured
  std::vector<Law> broken;          ///< by this record; statistical laws where they first stand out
  std::vector<FeatureId> features;  ///< blamed for it, by id
};

/// Judges a filter by the laws that a correct EKF-SLAM obeys (spec audit.md), from its snapshots
/// alone. Memory: O(N²), independent of the number of records.
///
///   Audit audit({}, reader.header());
///   while (auto snapshot = reader.next()) audit.take(*snapshot);
///   std::cout << reportText(audit.report());
///
/// Live: `auto subscription = audit.listen(filter);` takes every event. A `step` record that only
/// repeats the state of the record before it is passed over.
///
/// Cost per record of N states: O(N²·r), r the rank of the update, and O(N) probes for what can be
/// concluded from other laws; a decomposition of all of P only every ~N records.
///
/// Never throws for what a snapshot contains: a NaN, an indefinite or an asymmetric covariance is a
/// finding. Throws std::invalid_argument for options out of range.
class Audit {
 public:
  explicit Audit(AuditOptions options = {}, RunHeader header = {});
  ~Audit();
  Audit(Audit&&) noexcept;
  Audit& operator=(Audit&&) noexcept;

  /// The next record, in order of time.
  void take(const SnapshotPtr& snapshot);
  /// Attaches take() to a live source, for as long as the subscription is kept.
  [[nodiscard]] Subscription listen(Subject& subject);

  /// The verdict on everything taken so far. May be asked at any time: the statistical laws use
  /// bounds that hold at all times at once.
  [[nodiscard]] AuditReport report() const;
  /// Features and pairs to mark in the picture after the newest record.
  [[nodiscard]] Alarms alarms() const;
  /// What the newest record added. A record that was passed over leaves it as it was.
  [[nodiscard]] const RecordFindings& lastRecord() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slamscope::slam
