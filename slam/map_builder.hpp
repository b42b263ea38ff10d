// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "slam/association.hpp"
#include "slam/carried_ids.hpp"
#include "slam/ekf_slam.hpp"

namespace slamscope::slam {

/// When features come to be believed in, and when they go.
struct FeatureLifeOptions {
  /// Sightings, the first one included, that make a tentative feature a confirmed one.
  int confirm_after = 3;
  /// A tentative feature goes when it was expected in view and not seen so many times in a row.
  int drop_after = 3;
  /// A tentative feature goes, too, when it was not seen for so long. 0: never.
  std::chrono::nanoseconds longest_doubt = std::chrono::seconds(60);
  /// As drop_after, of a confirmed one; 0: those stay.
  int drop_confirmed_after = 0;
  /// m: two features whose estimates are nearer to each other than that are one; the one that was
  /// seen less often goes. No new feature begins that near to another. 0: never.
  double separation = 0.0;
  /// No new feature begins while so many are tentative: spurious returns by the thousand must not
  /// make a filter of thousands of states.
  int most_tentative = 100;
};

/// What became of readings and features since construction.
struct MapCounters {
  std::uint64_t paired = 0;        ///< readings of features of the map
  std::uint64_t ambiguous = 0;     ///< readings left out between the two gates
  std::uint64_t crowded = 0;       ///< readings left out: too many tentative, or too near
  std::uint64_t born = 0;          ///< features
  std::uint64_t confirmed = 0;     ///< features
  std::uint64_t dropped = 0;       ///< features expected and not seen, or in doubt for too long
  std::uint64_t duplicates = 0;    ///< features taken out because they were another
  std::uint64_t cut_searches = 0;  ///< times that a joint search reached its limit
};

/// EKF-SLAM without ids: stands between sensor and filter, says which feature each reading is of,
/// and keeps the map: tentative features, confirmed ones, and those that must go.
///
/// A tentative feature is in the state like any other, with all its correlations; snapshots name it
/// in `tentative`.
class MapBuilder {
 public:
  /// Whether the sensor would have seen something there that stands where the filter expects it:
  /// `z` its reading, `S` the covariance of that (without R).
  using View = std::function<bool(const Eigen::Vector2d& z, const Eigen::Matrix2d& S)>;

  /// `filter` must outlive this; gate of its own: none.
  MapBuilder(EkfSlam& filter, Association association, const AssociationGates& gates,
             const FeatureLifeOptions& life);

  /// All readings of one time, to which the filter has predicted. Features are called 1, 2, 3 …;
  /// the readings' ids are not looked at, but for keeping count (`carried`). Without a
  /// view nothing is ever expected.
  void observe(std::chrono::nanoseconds time, std::span<const Observation> readings,
               const View& view = {});

  [[nodiscard]] const MapCounters& counters() const { return counters_; }
  [[nodiscard]] bool confirmed(FeatureId id) const;
  /// Which ids the readings of the map's features carried.
  [[nodiscard]] const CarriedIds& carried() const { return carried_; }

 private:
  struct Life {
    int seen = 1;
    std::chrono::nanoseconds last{};  ///< time when it was seen last
    int missed = 0;                   ///< in a row
    bool confirmed = false;
  };

  [[nodiscard]] std::vector<Observation> named(std::span<const Observation> readings,
                                               const Matches& matches);
  void see(FeatureId id, FeatureId carried);
  [[nodiscard]] std::vector<FeatureId> missing(const Matches& matches, const View& view);
  [[nodiscard]] std::vector<Observation> births(std::span<const Observation> fresh);
  void mergeDuplicates();
  [[nodiscard]] FeatureId duplicateOf(FeatureId id) const;
  void remove(FeatureId id);
  void announceTentative();

  EkfSlam& filter_;
  Associator associator_;
  FeatureLifeOptions options_;
  MapCounters counters_;
  CarriedIds carried_;
  std::map<FeatureId, Life> lives_;
  std::vector<FeatureId> seen_last_;
  std::chrono::nanoseconds time_{};
  std::uint64_t tentative_ = 0;
  FeatureId last_name_ = 0;
};

}  // namespace slamscope::slam
