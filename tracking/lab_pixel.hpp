// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace slamscope::tracking::lab {

/// The mean of what many rays through one pixel see. What they meet is found for each of them,
/// which is where edges lie; how bright that is varies little within a pixel and takes long to say,
/// so that only the first few rays that meet a part are asked for it.
class PixelMean {
 public:
  /// One ray meets `part`; `colour()` says how bright it is there.
  template <class Colour>
  void add(int part, const Colour& colour) {
    Part& met = find(part);
    ++met.rays;
    if (met.coloured == kColoured) return;
    ++met.coloured;
    met.sum += colour();
  }

  [[nodiscard]] Eigen::Array3f mean() const {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    int rays = 0;
    for (const Part& part : parts_) {
      sum += part.sum * (static_cast<float>(part.rays) / static_cast<float>(part.coloured));
      rays += part.rays;
    }
    return sum / static_cast<float>(rays);
  }

 private:
  static constexpr int kColoured = 4;
  struct Part {
    int part, rays = 0, coloured = 0;
    Eigen::Array3f sum = Eigen::Array3f::Zero();
  };

  Part& find(int part) {
    for (Part& known : parts_)
      if (known.part == part) return known;
    return parts_.emplace_back(Part{.part = part});
  }

  std::vector<Part> parts_;
};

}  // namespace slamscope::tracking::lab
