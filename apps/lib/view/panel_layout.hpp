// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/scene/view.hpp"

namespace slamscope::apps {

/// Sizes in px of a picture that is 720 px high; others scale, down to what can still be read.
struct PanelLayout {
  double text = 14.0;
  double margin = 10.0;
  double padding = 7.0;
  double row = 19.0;
  double swatch = 12.0;
  double bar = 12.0;

  explicit PanelLayout(const engine::Pinhole& camera) {
    const double scale = std::clamp(camera.height / 720.0, 0.75, 3.0);
    for (double* size : {&text, &margin, &padding, &row, &swatch, &bar}) {
      *size = std::round(*size * scale);
    }
  }
};

}  // namespace slamscope::apps
