// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/gpu/gpu.hpp"
#include "engine/scene/planar_points.hpp"

namespace slamscope::engine {

/// All pairs of points between two groups a < b, in three: by the √det of their relative
/// covariances P_d the least and the greatest pair, and the mean of the matrices.
struct GroupPair {
  std::uint32_t a = 0, b = 0;
  std::pair<std::uint32_t, std::uint32_t> least, greatest;  ///< points i < j
  Eigen::Matrix2d mean = Eigen::Matrix2d::Zero();           ///< m²
};

/// Sums pairs of points up on the device: the host does nothing that grows with their number.
class GroupExtremes {
 public:
  explicit GroupExtremes(std::shared_ptr<Gpu> gpu);
  ~GroupExtremes();
  GroupExtremes(const GroupExtremes&) = delete;
  GroupExtremes& operator=(const GroupExtremes&) = delete;

  /// Why this device can't take the points, in a line for people; empty: it can.
  [[nodiscard]] std::string problemWith(const PlanarPoints& points) const;

  /// `groups`: the number of each point's group, 0, 1, … without a gap. For every two groups one,
  /// (0, 1) (0, 2) (1, 2) (0, 3) …; of a pair that has no finite P_d nothing is certain. Sends the
  /// points unless they are those of the call before, and waits for the device. Throws
  /// std::invalid_argument for another number of groups than of points, and std::runtime_error
  /// where there is a problem with the points.
  [[nodiscard]] std::vector<GroupPair> find(const PlanarPointsPtr& points,
                                            std::span<const std::uint32_t> groups);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::engine
