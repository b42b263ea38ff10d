// SPDX-License-Identifier: MIT
#include "slam/simulation_random.hpp"

#include <cmath>

namespace slamscope::slam {

double RandomSource::uniform() {
  return static_cast<double>(engine_() >> 11U) * 0x1.0p-53;
}

double RandomSource::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double u = 0.0;
  double v = 0.0;
  double s = 0.0;
  do {
    u = uniform(-1.0, 1.0);
    v = uniform(-1.0, 1.0);
    s = u * u + v * v;
  } while (s >= 1.0 || s == 0.0);
  const double factor = std::sqrt(-2.0 * std::log(s) / s);
  spare_ = v * factor;
  has_spare_ = true;
  return u * factor;
}

}  // namespace slamscope::slam
