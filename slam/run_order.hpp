// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Holds the records of one run to their order: time never goes back; ids keep their order;
/// features come with `initial`, `initialise` or `step` and go with `remove` or `step` only.
class RunOrder {
 public:
  /// The next record. What breaks the order throws std::runtime_error, "field: what was expected,
  /// what was found", and leaves the state as it was.
  void take(const SnapshotPtr& next);
  /// Another run begins: nothing came before.
  void restart() { last_ = nullptr; }

  [[nodiscard]] bool empty() const { return last_ == nullptr; }
  /// Pairs of neighbouring `step` (or `predict`) records with the same time: readable, but odd.
  [[nodiscard]] std::uint64_t equalStamps() const { return equal_stamps_; }

 private:
  SnapshotPtr last_;
  std::uint64_t equal_stamps_ = 0;
};

}  // namespace slamscope::slam
