// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace slamscope::tracking::lab {

/// Fixed pseudo-random numbers: the same for the same input, on every machine (splitmix64).
[[nodiscard]] constexpr std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The bare floor: square linoleum tiles, marbled and speckled, each a little different, with a 3 m
/// × 3 m field marked by tape, centred on the world's origin.
class Floor {
 public:
  explicit Floor(std::uint64_t seed);

  /// On the tape around the field.
  [[nodiscard]] static bool isTape(const Eigen::Vector2d& p_world);
  /// Albedo: blue, green, red, of 255.
  [[nodiscard]] Eigen::Array3f at(const Eigen::Vector2d& p_world) const;

 private:
  [[nodiscard]] float marble(double x, double y) const;

  std::uint64_t seed_;
  std::vector<float> marble_;  // tileable, kTexels², about −1..1
};

}  // namespace slamscope::tracking::lab
