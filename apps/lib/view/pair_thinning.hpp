// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/scene/pair_glyphs.hpp"

namespace slamscope::apps {

/// Which of the pairs that a mode shows are drawn.
struct PairThinning {
  std::uint32_t most = 0;  ///< so many, those that come first by `by`; 0: all
  engine::MostBy by = engine::MostBy::area;
  double least_area = 0.0;  ///< m², √det P_d; smaller pairs are not drawn
  bool in_view = false;     ///< only those both of whose features are in the picture

  [[nodiscard]] bool none() const { return most == 0 && least_area == 0.0 && !in_view; }
};

}  // namespace slamscope::apps
