// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "tracking/lab.hpp"
#include "tracking/lab_painter.hpp"

namespace slamscope::tracking::lab {

/// What lens and sensor do to the light: defocus, vignette, noise, rounding. Linear: no gamma.
class Sensor {
 public:
  explicit Sensor(const LabOptions& options);

  /// Blurs and vignettes a region of `light` into the same region of `exposed` (both of the
  /// camera's size). Reads up to margin() pixels beyond the region.
  void expose(const Canvas& light, const Region& region, Canvas& exposed) const;
  [[nodiscard]] int margin() const { return margin_; }

  /// Adds frame k's noise and rounds: rows from the top, blue green red.
  [[nodiscard]] std::vector<std::uint8_t> read(const Canvas& exposed, std::uint64_t k) const;

 private:
  int width_, height_, margin_;
  double defocus_px_, vignette_;
  std::uint64_t seed_;
  std::vector<float>
      noise_;  // a field larger than the picture; each frame is cut from another place
};

}  // namespace slamscope::tracking::lab
