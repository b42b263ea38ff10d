// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "slam/ekf_equations.hpp"

namespace slamscope::slam::bench {

/// MRPT's CRangeBearingKFSLAM2D behind our types, ids known.
class MrptEkf {
 public:
  enum class Settings {
    /// As it comes: all of P at once, the sensor sees all around and far, so that the readings of
    /// all features are predicted.
    by_default,
    /// kfEKFAlaDavison, one observation after the other; a sensor that expects nothing, so that
    /// only what was read is predicted; no map of frames.
    fastest
  };

  /// A map of what was first seen from the origin.
  MrptEkf(Settings settings, const std::vector<Observation>& first);
  ~MrptEkf();
  MrptEkf(MrptEkf&&) noexcept;

  void step(const Motion& motion, const std::vector<Observation>& readings);
  [[nodiscard]] Eigen::Vector3d pose() const;
  [[nodiscard]] int featureCount() const;

 private:
  struct Filter;
  std::unique_ptr<Filter> filter_;
};

}  // namespace slamscope::slam::bench
