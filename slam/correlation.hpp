// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Equation (13): P_d = P_ii + P_jj − P_ij − P_ijᵀ, the covariance (m²) of f_i − f_j, for the
/// features at `i` and `j` in state order. Throws std::invalid_argument where only the diagonal was
/// logged: P_ij is unknown there.
[[nodiscard]] Eigen::Matrix2d relativeCovariance(const Snapshot& snapshot, int i, int j);

/// Size of a covariance as the paper orders them, √det (m²); 0 for a singular one.
[[nodiscard]] double ellipseArea(const Eigen::Matrix2d& covariance);

/// Principal axes of a symmetric 2×2 matrix. A semi-definite one has its least eigenvalue at 0 or
/// above: what rounding puts below by up to 1e-12 of the other is 0.
struct PrincipalAxes {
  Eigen::Vector2d eigenvalues = Eigen::Vector2d::Zero();  ///< major first
  double angle = 0.0;  ///< rad, of the major axis from x, in (−π/2, π/2]
  /// Unit eigenvectors in columns, major first, right-handed.
  [[nodiscard]] Eigen::Matrix2d directions() const;
};

/// Closed form; reads the lower triangle.
[[nodiscard]] PrincipalAxes principalAxes(const Eigen::Matrix2d& covariance);

/// What the length of a glyph's axis stands for. eigenvalue: the paper's, gain · λ (m² as metres).
/// sigma: gain · k √λ, true metres at gain 1. log: gain · 0.1 m · log10(1 + k √λ / 1 mm), a tenth
/// of a metre a decade, for maps whose λ span orders of magnitude.
enum class Axis { eigenvalue, sigma, log };

struct AxisScale {
  Axis axis = Axis::sigma;
  double k = 3.0;
  double gain = 1.0;

  /// Semi-axis (m) for an eigenvalue λ (m²); 0 for λ ≤ 0. Strictly monotone in λ, never clamped.
  [[nodiscard]] double semiAxis(double eigenvalue) const;
};

}  // namespace slamscope::slam
