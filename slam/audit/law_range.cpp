// SPDX-License-Identifier: MIT
#include "slam/audit/law_range.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/audit/change_range.hpp"

namespace slamscope::slam {
namespace {

/// The span in which Δx must lie: the lawful one, or where that is not D's, D's own.
SpanBasis spanOf(const Transition& t, const UpdateAnatomy& anatomy) {
  if (anatomy.fit.whole || !anatomy.outside.empty()) return anatomy.basis;
  const int rank = 2 * static_cast<int>(anatomy.observed.size());
  const ChangeRange range = rangeOfChange(t, rank, 2 * rank + 8);
  SpanBasis basis;
  if (!range.complete) return basis;
  basis.W = range.Q;
  basis.noise = Eigen::VectorXd::Constant(range.Q.cols(), range.noise);
  return basis;
}

}  // namespace

double rangeTolerance(const Transition& t, double span, double size) {
  const double rounding = 2.0 * t.mean_noise * t.largest_scale;
  return 1e-5 + (span + 8.0 * rounding) / size;
}

Outcome checkRange(const Transition& t, const UpdateAnatomy& anatomy) {
  if (anatomy.support.kind != Outcome::Kind::checked) {
    return Outcome::notCheckable(anatomy.support.reason);
  }
  SpanBasis kept = spanOf(t, anatomy);
  if (kept.W.cols() == 0) return Outcome::notCheckable("range(D) is not known");
  ProbedChange mean;  // one "probe": the change of the mean
  mean.Omega = Eigen::MatrixXd::Zero(t.size(), 1);
  const Eigen::VectorXd change = t.meanChange();
  mean.Y = t.scale.cwiseProduct(change);
  for (const int state : statesOf(anatomy.outside)) {
    kept.W.row(state).setZero();
    mean.Y.row(state).setZero();
  }
  const double size = mean.Y.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return Outcome::of(0.0, 0.0);
  const bool as_fitted = anatomy.fit.whole && anatomy.outside.empty();
  SpanFit fit = as_fitted ? fitSpan(t, mean, anatomy.span) : fitSpan(t, mean, kept);
  if (!fit.whole && std::abs(change[2]) > 1.5) {
    // A gain that turns the heading by more than half a turn can't be told from one by less.
    kept.W.row(2).setZero();
    mean.Y.row(2).setZero();
    const SpanFit without = fitSpan(t, mean, kept);
    if (without.whole) fit = without;
  }
  const double tolerance = rangeTolerance(t, fit.tolerance * size, size);
  if (tolerance > 0.2) return Outcome::notCheckable("the change of x drowns in the log's rounding");
  Outcome outcome = Outcome::of(fit.residual, tolerance);
  if (!outcome.violated()) return outcome;
  const Eigen::VectorXd outside = fit.outside.col(0).cwiseAbs2();
  const double total = outside.sum();
  for (int i = 0; i < t.shared; ++i) {
    const double share = outside.segment<2>(Snapshot::row(i)).sum() / total;
    if (share > 0.1) outcome.blame.push_back({t.id(i), share});
  }
  outcome.amount = std::to_string(100.0 * fit.residual) +
                   " % of the change of the state lies outside the range of P's change";
  return outcome;
}

}  // namespace slamscope::slam
