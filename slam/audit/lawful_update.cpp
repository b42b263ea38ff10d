// SPDX-License-Identifier: MIT
#include "slam/audit/lawful_update.hpp"

#include <algorithm>
#include <cmath>

#include "slam/audit/law_positive.hpp"
#include "slam/audit/law_range.hpp"
#include "slam/audit/law_shrink.hpp"
#include "slam/audit/tall_comparison.hpp"

namespace slamscope::slam {
namespace {

/// Where rounding could hide more than this share nothing is confirmed.
constexpr double kMostUnseen = 0.05;

/// Error of an image of D. Those of U, times their weights, come on top, but a filter that
/// calculates with doubles keeps far below, and what stays within this alone is beyond doubt.
double roundingOf(const Transition& t) {
  return t.noise * std::sqrt(static_cast<double>(t.size()));
}

}  // namespace

void LawfulUpdate::take(const Transition& t, const UpdateSweep& sweep) {
  recognised_ = false;
  const auto rank = 2 * static_cast<int>(t.observed.size());
  const bool applies = t.observed_given && rank > 0 && rank < t.size() && !t.rounded &&
                       sweep.finite() && sweep.leastVariance() >= 0.0;
  if (!applies) return;
  B_.take(t);
  B_.project(sweep.blockBefore(), T_);
  if (!fits(t, sweep) || !featuresShrink(t, sweep.diagonal(), sweep.besideDiagonal())) return;
  B_.project(sweep.blockOfChange(), M_);
  if (!shrinksAndStaysPositive(t, sweep)) return;
  measure(t);
  recognised_ = true;
}

bool LawfulUpdate::fits(const Transition& t, const UpdateSweep& sweep) {
  tall_.setZero(sweep.columns().rows(), kComparedImages + 1);
  tall_.col(0) = sweep.image();
  tall_.col(1).head(t.size()) = t.meanChange();
  tall_.col(2).head(t.size()) = t.scale;
  const auto states = static_cast<Eigen::Index>(sweep.states().size());
  picked_.setZero(4, states);
  for (Eigen::Index q = 0; q < states; ++q) {
    picked_.col(q).head<2>() = tall_.row(sweep.states()[static_cast<std::size_t>(q)]).head<2>();
  }
  B_.project(picked_, relative_);
  factor_ = T_;
  if (!factorise(factor_)) return false;
  coefficients_ = relative_;
  solveFour(factor_, coefficients_);
  if (!coefficients_.allFinite()) return false;
  B_.lift(coefficients_, weights_);  // U c = P⁻ (Bᵀ c)
  compareTall(sweep.columns(), weights_, tall_, largest_);
  return confirmsSupport(t) && confirmsRange(t);
}

bool LawfulUpdate::confirmsSupport(const Transition& t) {
  const double size = largest_(0, 0);
  support_.residual = largest_(1, 0) / size;
  support_.tolerance = spanTolerance(roundingOf(t), size) / size;
  return support_.residual <= support_.tolerance && support_.tolerance <= kMostUnseen;
}

bool LawfulUpdate::confirmsRange(const Transition& t) {
  range_ = {};
  const double size = largest_(0, 1);
  if (size == 0.0) return true;
  range_.residual = largest_(1, 1) / size;
  range_.tolerance = rangeTolerance(t, spanTolerance(roundingOf(t), size), size);
  return range_.residual <= range_.tolerance && range_.tolerance <= kMostUnseen;
}

bool LawfulUpdate::shrinksAndStaysPositive(const Transition& t, const UpdateSweep& sweep) {
  const double tolerance = positiveTolerance(t.noise, sweep.states().size());
  // A row's own size after the update, which may be much smaller than before.
  const auto sigma_after = [&](int state) {
    return std::sqrt(std::max(0.0, t.sigma[state] * t.sigma[state] - sweep.diagonal()[state]));
  };
  const Eigen::Vector3d robot(sigma_after(0), sigma_after(1), sigma_after(2));
  rest_.resize(B_.size());
  for (Eigen::Index m = 0; m < B_.size(); ++m) {
    const Eigen::Index rows = B_.size() - m;
    Eigen::Map<Eigen::ArrayXd>(rest_.column(m) + m, rows) =
        Eigen::Map<const Eigen::ArrayXd>(T_.column(m) + m, rows) -
        Eigen::Map<const Eigen::ArrayXd>(M_.column(m) + m, rows);
    const double size = sigma_after(sweep.states()[static_cast<std::size_t>(3 + m)]) +
                        robot[m % 2] + B_.lever(m) * robot[2];
    rest_(m, m) += tolerance * size * size;
  }
  factor_ = M_;
  const Factorised both = factoriseBoth(factor_, rest_);
  regular_ = both.first;
  return both.second && (regular_ || shrinksWithin(shrinkTolerance(t)));
}

bool LawfulUpdate::shrinksWithin(double tolerance) {
  factor_ = M_;
  for (Eigen::Index m = 0; m < B_.size(); ++m) {
    factor_(m, m) += tolerance * B_.sigma()[m] * B_.sigma()[m];
  }
  return factorise(factor_);
}

void LawfulUpdate::measure(const Transition& t) {
  const Eigen::ArrayXd& sigma = B_.sigma();
  const Eigen::Index size = B_.size();
  double largest = 0.0;  // trace of M, scaled by σ
  for (Eigen::Index m = 0; m < size; ++m) largest += M_(m, m) / (sigma[m] * sigma[m]);
  const double least = leastResolved(t, size + 3, largest);
  if (regular_ && measureAll(t, least)) return;
  // What drowns in the noise is left out: late in a run nearly all but the robot's three.
  for (Eigen::Index m = 0; m < size; ++m) {
    Eigen::Map<Eigen::ArrayXd>(M_.column(m), size) /= sigma * sigma[m];
  }
  relative_change_ = relative_.row(1).transpose().array() / sigma;
  const Resolved resolved = squaredOverResolved(M_, relative_change_, least);
  innovation_.nis = resolved.squared;
  innovation_.dof = resolved.rank;
  innovation_.features.clear();
}

bool LawfulUpdate::measureAll(const Transition& t, double least_resolved) {
  const Eigen::Index size = B_.size();
  solved_.setZero(size, (2 * size + 1 + 3) / 4 * 4);
  for (Eigen::Index i = 0; i < size; ++i) {
    solved_.row(i).head(size) = Eigen::Map<const Eigen::RowVectorXd>(T_.column(i), size);
    solved_(i, size) = relative_(1, i);
    solved_(i, size + 1 + i) = 1.0;
  }
  solveForward(factor_, solved_, size + 1);
  squaresOf(solved_, size, squares_, innovations_);
  double inverse = 0.0;  // trace of M⁻¹, scaled by 1 / σ
  for (Eigen::Index m = 0; m < size; ++m) {
    inverse += B_.sigma()[m] * B_.sigma()[m] * squares_[size + 1 + m];
  }
  const double least = 1.0 / inverse;
  if (!(least > least_resolved)) return false;
  innovation_.nis = squares_[size];
  innovation_.dof = static_cast<int>(size);
  innovation_.features.resize(t.observed.size());
  for (Eigen::Index k = 0; k < size / 2; ++k) measureFeature(t, k, least);
  return true;
}

void LawfulUpdate::measureFeature(const Transition& t, Eigen::Index k, double least) {
  const Eigen::Index column = 2 * k;
  FeatureInnovation& one = innovation_.features[static_cast<std::size_t>(k)];
  one.id = t.id(t.observed[static_cast<std::size_t>(k)]);
  one.dof = 2;
  const double cross = solved_.col(column).dot(solved_.col(column + 1));
  Eigen::Matrix2d S;
  S << squares_[column], cross, cross, squares_[column + 1];
  const Eigen::Vector2d nu = innovations_.segment<2>(column);
  one.nis = nu.dot(S.inverse() * nu);
  Eigen::Matrix2d T;
  T << T_(column, column), T_(column + 1, column), T_(column + 1, column),
      T_(column + 1, column + 1);
  one.R_map = S - T;
  one.R_error = noiseError(t, least, S, one.R_map);
}

}  // namespace slamscope::slam
