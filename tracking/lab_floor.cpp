// SPDX-License-Identifier: MIT
#include "tracking/lab_floor.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::tracking::lab {
namespace {

constexpr double kTile = 0.5;                      // m
constexpr double kJoint = 0.0025;                  // half width of the joint between tiles, m
constexpr int kTexels = 512;                       // of the marble pattern, which is 1 m wide
constexpr double kField = 1.5, kTapeWidth = 0.05;  // half side of the field, width of its tape, m

float random01(std::uint64_t key) {
  return static_cast<float>(hash(key) >> 40) / 16777216.0F;
}

/// Smooth noise on a lattice of `cells` across the pattern, which it repeats.
float valueNoise(std::uint64_t key, double x, double y, int cells) {
  const auto corner = [&](int column, int row) {
    const auto wrap = [&](int i) {
      return static_cast<std::uint64_t>((i % cells + cells) % cells);
    };
    return 2 * random01(key ^ hash(wrap(column) * 65537 + wrap(row))) - 1;
  };
  const double u = x * cells, v = y * cells;
  const int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
  const auto ease = [](double f) { return static_cast<float>(f * f * (3 - 2 * f)); };
  const float fu = ease(u - column), fv = ease(v - row);
  return (1 - fv) * ((1 - fu) * corner(column, row) + fu * corner(column + 1, row)) +
         fv * ((1 - fu) * corner(column, row + 1) + fu * corner(column + 1, row + 1));
}

}  // namespace

Floor::Floor(std::uint64_t seed) : seed_(hash(seed)), marble_(kTexels * kTexels) {
  for (int row = 0; row < kTexels; ++row)
    for (int column = 0; column < kTexels; ++column) {
      double x = (column + 0.5) / kTexels, y = (row + 0.5) / kTexels;
      // Bent coordinates turn blobs into veins.
      const double bent = x + 0.06 * valueNoise(seed_ ^ 11, x, y, 6);
      y += 0.06 * valueNoise(seed_ ^ 12, x, y, 6);
      x = bent;
      float value = 0.45F * valueNoise(seed_ ^ 1, x, y, 7) +
                    0.30F * valueNoise(seed_ ^ 2, x, y, 19) +
                    0.25F * valueNoise(seed_ ^ 3, x, y, 53);
      const float fleck = valueNoise(seed_ ^ 4, x, y, 131);
      if (fleck > 0.55F) value += 1.4F * (fleck - 0.55F);
      if (fleck < -0.6F) value += 2.0F * (fleck + 0.6F);
      marble_[row * kTexels + column] = value;
    }
}

float Floor::marble(double x, double y) const {
  const auto wrap = [](int i) { return i & (kTexels - 1); };
  const double u = x * kTexels - 0.5, v = y * kTexels - 0.5;
  const int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
  const auto fu = static_cast<float>(u - column), fv = static_cast<float>(v - row);
  const float* a = &marble_[wrap(row) * kTexels];
  const float* b = &marble_[wrap(row + 1) * kTexels];
  const int left = wrap(column), right = wrap(column + 1);
  return (1 - fv) * ((1 - fu) * a[left] + fu * a[right]) +
         fv * ((1 - fu) * b[left] + fu * b[right]);
}

bool Floor::isTape(const Eigen::Vector2d& p_world) {
  const double edge = p_world.cwiseAbs().maxCoeff() - kField;
  return edge >= 0 && edge < kTapeWidth;
}

Eigen::Array3f Floor::at(const Eigen::Vector2d& p_world) const {
  if (isTape(p_world)) {
    const float wear = marble(2.3 * p_world.x(), 2.3 * p_world.y());
    return Eigen::Array3f(150, 92, 38) * (1 + 0.07F * wear);
  }
  // The field's edge does not fall on a joint.
  const double x = p_world.x() / kTile + 0.31, y = p_world.y() / kTile + 0.17;
  const double column = std::floor(x), row = std::floor(y);
  const auto tile_index = static_cast<std::uint64_t>(static_cast<std::int64_t>(column) * 7919 +
                                                     static_cast<std::int64_t>(row));
  const std::uint64_t tile = hash(seed_ ^ hash(tile_index));
  double u = x - column, v = y - row;
  const double from_joint = kTile * std::min({u, v, 1 - u, 1 - v});
  // Each tile is cut from its own place of the pattern, laid either way.
  if ((tile & 1) != 0) std::swap(u, v);
  const float value = marble(0.5 * u + random01(tile ^ 1), 0.5 * v + random01(tile ^ 2));
  const float shade = 1 + 0.050F * (2 * random01(tile ^ 3) - 1) + 0.085F * value;
  const float warmth = 0.018F * (2 * random01(tile ^ 4) - 1) + 0.02F * value;
  const auto joint = static_cast<float>(std::max(0.0, 1 - from_joint / (2 * kJoint)));
  const Eigen::Array3f base(174, 177, 174);
  return base * Eigen::Array3f(1 - warmth, 1, 1 + warmth) * (shade - 0.28F * joint);
}

}  // namespace slamscope::tracking::lab
