// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "slam/angle.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam::experiments {

/// How the numbers of a log were written.
enum class Precision { exact, float32, text6 };
inline constexpr std::array kPrecisions{Precision::exact, Precision::float32, Precision::text6};
[[nodiscard]] std::string_view precisionName(Precision precision);

/// What a log contains: steps alone; every event; every event with observations, control and Q.
enum class Level { l1, l2, l3 };
[[nodiscard]] std::string_view levelName(Level level);

/// The same value as if it had been written with this precision and read back.
[[nodiscard]] double rounded(double value, Precision precision);

/// One way of logging a run.
struct LogKind {
  Level level = Level::l2;
  Precision precision = Precision::exact;
  bool declared = false;  ///< R in the header and Q in the records, at any level
  bool truth = false;
};

/// "L2 float32 declared".
[[nodiscard]] std::string kindName(const LogKind& kind);

/// What somebody would have logged of a snapshot that carries everything. Absent where the level
/// has no such record.
[[nodiscard]] SnapshotPtr logged(const SnapshotPtr& snapshot, const LogKind& kind);

/// Lengths in other units: `scale` of them to a metre (1000: millimetres).
[[nodiscard]] SnapshotPtr inUnits(const SnapshotPtr& snapshot, Sensor sensor, double scale);
[[nodiscard]] RunHeader inUnits(RunHeader header, double scale);

/// Headings as a filter has them that never wraps.
class Unwrapper {
 public:
  [[nodiscard]] SnapshotPtr operator()(const SnapshotPtr& snapshot);

 private:
  double heading_ = 0.0;
};

}  // namespace slamscope::slam::experiments
