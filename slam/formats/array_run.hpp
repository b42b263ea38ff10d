// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slam/formats/feature_places.hpp"
#include "slam/formats/slices.hpp"
#include "slam/run_order.hpp"
#include "slam/run_source.hpp"

namespace slamscope::slam {

/// A run that was saved as arrays: x and P of each step, and what may stand beside them.
struct RunArrays {
  std::size_t steps = 0;
  std::unique_ptr<Slices> P;         ///< N×N a step, or N: the diagonal alone (level L0)
  std::unique_ptr<Slices> x;         ///< N = 3 + 2n a step; absent: means unknown (level LC)
  std::vector<double> times;         ///< s; empty: the number of the step
  std::vector<double> names;         ///< ids by place, for all steps; empty: 1, 2, …
  std::unique_ptr<Slices> ids;       ///< by place, a step; NaN or negative where there is none
  std::unique_ptr<Slices> observed;  ///< ids, padded likewise, or a mask over places
  bool observed_is_mask = false;
  std::unique_ptr<Slices> truth;    ///< true pose
  std::vector<std::string> events;  ///< as eventName; empty: `step`
  std::vector<std::string> warnings;
};

/// Turns arrays into records. Unreadable are, as "path: record 12: field: …": sizes that do not fit
/// together, ids or events that are none, time that goes back, and features that vanish or change
/// place without ids. What is padding and what is a NaN: see FeaturePlaces; where ids are given,
/// they say which places hold a feature.
class ArrayRun : public RunSource {
 public:
  /// Throws std::runtime_error where times, names or events are not as many as needed.
  ArrayRun(std::string path, RunArrays arrays);

  [[nodiscard]] SnapshotPtr next() override;
  [[nodiscard]] const RunHeader& header() const override { return header_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const override {
    return arrays_.warnings;
  }

 private:
  [[nodiscard]] SnapshotPtr read();
  /// Places that hold a feature, and their ids in the snapshot.
  [[nodiscard]] std::vector<int> readIds(Snapshot& snapshot, std::span<const double> x,
                                         std::span<const double> P, std::size_t size);
  void readObserved(Snapshot& snapshot, const std::vector<int>& places, std::size_t all);
  void readTruth(Snapshot& snapshot);
  void finish();

  std::string path_;
  RunArrays arrays_;
  RunHeader header_;
  FeaturePlaces places_;
  RunOrder order_;
  std::size_t step_ = 0;
  std::vector<double> part_;  ///< of P: the rows that hold a feature
};

}  // namespace slamscope::slam
