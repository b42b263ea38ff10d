// SPDX-License-Identifier: MIT
#include "apps/lib/view/palette.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace slamscope::apps {
namespace {

/// How people see linear RGB who lack one kind of cone, wholly (Machado, Oliveira and Fernandes
/// 2009, severity 1), and all others.
const std::array<Eigen::Matrix3d, 4> kEyes = [] {
  std::array<Eigen::Matrix3d, 4> eyes;
  eyes[0].setIdentity();
  eyes[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
      1.051998;
  eyes[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
      0.968881;
  eyes[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367,
      0.303900;
  return eyes;
}();

Eigen::Vector3d linear(const engine::Rgba& colour) {
  const auto one = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return {one(colour.r), one(colour.g), one(colour.b)};
}

/// CIE L*a*b* of linear sRGB, white D65.
Eigen::Vector3d lab(const Eigen::Vector3d& rgb) {
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  const Eigen::Array3d xyz = (to_xyz * rgb).array() / Eigen::Array3d(0.95047, 1.0, 1.08883);
  const Eigen::Array3d f = xyz.unaryExpr([](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  });
  return {116.0 * f(1) - 16.0, 500.0 * (f(0) - f(1)), 200.0 * (f(1) - f(2))};
}

/// Of two colours for the eyes that tell them apart worst. CIE 1976; 2.3 is just noticeable.
double leastDifference(const engine::Rgba& a, const engine::Rgba& b) {
  double least = 1e9;
  for (const Eigen::Matrix3d& eye : kEyes) {
    const auto seen = [&eye](const engine::Rgba& colour) {
      return lab((eye * linear(colour)).cwiseMax(0.0).cwiseMin(1.0));
    };
    least = std::min(least, (seen(a) - seen(b)).norm());
  }
  return least;
}

/// Between any two roles that stand for different things.
double leastDifference(const Palette& p) {
  const std::array roles{p.robot, p.heading, p.feature, p.tentative, p.ellipsoid, p.flagged};
  double least = 1e9;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, leastDifference(roles[i], roles[j]));
  }
  return least;
}

TEST(Palette, SafeRolesAreApartForEveryEye) {
  constexpr double kApart = 20.0;
  EXPECT_GT(leastDifference(paletteOf(PaletteName::safe)), kApart);
  // Twin: the paper's colours are not, its red and green least of all.
  const Palette& paper = paletteOf(PaletteName::paper);
  EXPECT_LT(leastDifference(paper), kApart);
  EXPECT_LT(leastDifference(paper.robot, paper.ellipsoid), kApart);
}

TEST(Palette, DifferenceIsThatOfTheDefinition) {
  const engine::Rgba black{0, 0, 0}, white{1, 1, 1};
  EXPECT_NEAR((lab(linear(white)) - lab(linear(black))).norm(), 100.0, 0.05);
  // sRGB's red is L*a*b* (53.24, 80.09, 67.20).
  EXPECT_LT((lab(linear({1, 0, 0})) - Eigen::Vector3d(53.24, 80.09, 67.20)).norm(), 0.05);
  // Greys look alike to everybody.
  for (const Eigen::Matrix3d& eye : kEyes) {
    EXPECT_LT((eye * Eigen::Vector3d::Ones() - Eigen::Vector3d::Ones()).norm(), 1e-5);
  }
}

TEST(Palette, HasTwoNames) {
  for (const PaletteName name : {PaletteName::paper, PaletteName::safe}) {
    EXPECT_EQ(paletteFromName(paletteName(name)), name);
  }
  EXPECT_THROW((void)paletteFromName("gaudy"), std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::apps
