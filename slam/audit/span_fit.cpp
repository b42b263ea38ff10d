// SPDX-License-Identifier: MIT
#include "slam/audit/span_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/audit/thin_q.hpp"

namespace slamscope::slam {
namespace {

/// Pivots below this and the Gram matrix loses too much: then Householder, with column pivots.
constexpr double kLeastPivot = 1e-4;

/// W ← Q, R by Cholesky QR, twice. False, W undefined, where a pivot is small.
bool choleskyQr(Eigen::MatrixXd& W, Eigen::MatrixXd& R) {
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::MatrixXd gram = W.transpose() * W;
    const Eigen::LLT<Eigen::MatrixXd> factor(gram);
    if (factor.info() != Eigen::Success) return false;
    const Eigen::MatrixXd L = factor.matrixL();
    if (!(L.diagonal().minCoeff() > kLeastPivot)) return false;
    factor.matrixU().solveInPlace<Eigen::OnTheRight>(W);
    R = pass == 0 ? Eigen::MatrixXd(L.transpose()) : Eigen::MatrixXd(L.transpose() * R);
  }
  return true;
}

/// Y without the rows and columns of D at `without`.
Eigen::MatrixXd restricted(const Transition& t, const ProbedChange& change,
                           const std::vector<int>& without) {
  Eigen::MatrixXd Y = change.Y;
  for (const int state : without) {
    if (state < change.begin) continue;
    for (Eigen::Index row = 0; row < Y.rows(); ++row) {
      Y.row(row) -= t.change(change.begin + static_cast<int>(row), state) *
                    change.Omega.row(state - change.begin);
    }
  }
  for (const int state : without) {
    if (state >= change.begin) Y.row(state - change.begin).setZero();
  }
  return Y;
}

/// Squared residual that goes away when the rows of a block are taken out of the least squares:
/// rᵀ (I − Q_b Q_bᵀ)⁻¹ r, leverage included.
double relief(const Eigen::MatrixXd& Q, const Eigen::MatrixXd& outside, int row, int rows) {
  const auto Q_b = Q.middleRows(row, rows);
  const Eigen::MatrixXd r = outside.middleRows(row, rows);
  Eigen::MatrixXd G = Eigen::MatrixXd::Identity(rows, rows) - Q_b * Q_b.transpose();
  G.diagonal().array() += 1e-12;
  return (r.transpose() * G.llt().solve(r)).trace();
}

/// Features with a variance that an update made larger.
std::vector<int> growingFeatures(const Transition& t) {
  std::vector<int> growing;
  const double tolerance = 1e-8 + 8.0 * t.noise;
  for (int i = 0; i < t.shared; ++i) {
    const int r = Snapshot::row(i);
    if (t.change(r, r) < -tolerance || t.change(r + 1, r + 1) < -tolerance) growing.push_back(i);
  }
  return growing;
}

}  // namespace

OrthonormalSpan orthonormal(const SpanBasis& basis, const std::vector<int>& without) {
  OrthonormalSpan span;
  Eigen::MatrixXd W = basis.W;
  Eigen::VectorXd noise = basis.noise;
  for (const int state : without) {
    if (state >= basis.begin) W.row(state - basis.begin).setZero();
  }
  for (Eigen::Index c = 0; c < W.cols(); ++c) {
    const double length = W.col(c).norm();
    if (!(length > 0.0)) continue;
    W.col(c) /= length;
    noise[c] /= length;
  }
  span.Q.resize(W.rows(), 0);
  if (W.cols() == 0) return span;
  const double drowned =
      std::max(1e-13, 10.0 * noise.maxCoeff() * std::sqrt(static_cast<double>(W.rows())));
  if (drowned < kLeastPivot && W.cols() <= W.rows()) {
    span.Q = W;
    span.noise = noise;
    if (choleskyQr(span.Q, span.R)) return span;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(W);
  // A direction that drowns is kept: to leave it out would leave out what D has along it.
  Eigen::Index rank = 0;
  const Eigen::Index most = std::min(W.rows(), W.cols());
  while (rank < most && std::abs(qr.matrixR()(rank, rank)) > 1e-14) ++rank;
  span.all_resolved = rank == W.cols() && std::abs(qr.matrixR()(rank - 1, rank - 1)) > drowned;
  span.Q = thinQ(qr, rank);
  span.R = qr.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
  span.noise.resize(rank);
  for (Eigen::Index c = 0; c < rank; ++c) {
    span.noise[c] = noise[qr.colsPermutation().indices()[c]];
  }
  return span;
}

SpanBasis observationBasis(const Transition& t, const std::vector<int>& features,
                           const std::vector<Eigen::Vector2d>& deltas) {
  SpanBasis basis;
  basis.W.resize(t.size(), 2 * static_cast<Eigen::Index>(features.size()));
  basis.noise.resize(basis.W.cols());
  const Eigen::VectorXd x = t.scaledColumn(0);
  const Eigen::VectorXd y = t.scaledColumn(1);
  const Eigen::VectorXd theta = t.scaledColumn(2);
  for (std::size_t k = 0; k < features.size(); ++k) {
    const int row = Snapshot::row(features[k]);
    const auto col = 2 * static_cast<Eigen::Index>(k);
    const Eigen::Vector2d& delta = deltas[k];
    basis.W.col(col) = t.scaledColumn(row) - x + delta.y() * theta;
    basis.W.col(col + 1) = t.scaledColumn(row + 1) - y - delta.x() * theta;
    for (int axis = 0; axis < 2; ++axis) {
      basis.noise[col + axis] =
          t.noise * (t.sigma[row + axis] + t.sigma[axis] + t.sigma[2] * delta.norm()) +
          2.0 * t.mean_noise * t.sigma[2];
    }
  }
  return basis;
}

SpanBasis looseBasis(const Transition& t, const std::vector<int>& features, int begin) {
  SpanBasis basis;
  basis.begin = begin;
  const int rows = t.size() - begin;
  basis.W.resize(rows, 2 * static_cast<Eigen::Index>(features.size()) + 1);
  basis.noise.resize(basis.W.cols());
  const Eigen::VectorXd x = t.scaledColumn(0).tail(rows);
  const Eigen::VectorXd y = t.scaledColumn(1).tail(rows);
  for (std::size_t k = 0; k < features.size(); ++k) {
    const int row = Snapshot::row(features[k]);
    const auto col = 2 * static_cast<Eigen::Index>(k);
    basis.W.col(col) = t.scaledColumn(row).tail(rows) - x;
    basis.W.col(col + 1) = t.scaledColumn(row + 1).tail(rows) - y;
    for (int axis = 0; axis < 2; ++axis) {
      basis.noise[col + axis] = t.noise * (t.sigma[row + axis] + t.sigma[axis]);
    }
  }
  basis.W.rightCols<1>() = t.scaledColumn(2).tail(rows);
  basis.noise[basis.W.cols() - 1] = t.noise * t.sigma[2];
  return basis;
}

std::vector<Eigen::Vector2d> lawfulDeltas(const Snapshot& snapshot,
                                          const std::vector<int>& features) {
  std::vector<Eigen::Vector2d> deltas;
  deltas.reserve(features.size());
  for (const int i : features) {
    deltas.emplace_back(snapshot.features[static_cast<std::size_t>(i)] - snapshot.pose.head<2>());
  }
  return deltas;
}

ProbedChange probeChange(const Transition& t, int begin, int count) {
  ProbedChange change;
  change.begin = begin;
  fillProbes(t.after->sequence, t.size() - begin, count, change.Omega);
  change.Y = changeTimes(t, begin, change.Omega);
  return change;
}

SpanFit fitSpan(const Transition& t, const ProbedChange& change, const SpanBasis& basis,
                const std::vector<int>& without) {
  return fitSpan(t, change, orthonormal(basis, without), without);
}

SpanFit fitSpan(const Transition& t, const ProbedChange& change, const OrthonormalSpan& span,
                const std::vector<int>& without) {
  SpanFit fit;
  const Eigen::MatrixXd Y = without.empty() ? change.Y : restricted(t, change, without);
  Eigen::MatrixXd weight = span.Q.transpose() * Y;
  fit.outside = Y - span.Q * weight;
  // How much the error of each basis vector matters: its weight in Y.
  span.R.triangularView<Eigen::Upper>().solveInPlace(weight);
  const double rounding = t.noise * std::sqrt(static_cast<double>(Y.rows()));
  double worst = 0.0;
  double largest = 0.0;
  fit.checkable = true;
  fit.whole = true;
  for (Eigen::Index k = 0; k < Y.cols(); ++k) {
    double error = rounding;
    for (Eigen::Index c = 0; c < weight.rows(); ++c)
      error += span.noise[c] * std::abs(weight(c, k));
    const double size = Y.col(k).cwiseAbs().maxCoeff();
    if (size == 0.0) continue;
    const double tolerance = spanTolerance(error, size);
    const double residual = fit.outside.col(k).cwiseAbs().maxCoeff();
    if (!(residual <= tolerance)) fit.whole = false;
    if (tolerance > 0.05 * size || (t.rounded && !span.all_resolved)) fit.checkable = false;
    if (residual >= worst) {
      worst = residual;
      fit.tolerance = tolerance;
    }
    largest = std::max(largest, size);
  }
  fit.residual = largest > 0.0 ? worst / largest : 0.0;
  fit.tolerance = largest > 0.0 ? fit.tolerance / largest : 0.0;
  return fit;
}

std::vector<int> statesOf(const std::vector<int>& blocks) {
  std::vector<int> states;
  for (const int block : blocks) {
    if (block < 0) {
      states.insert(states.end(), {0, 1, 2});
    } else {
      states.push_back(Snapshot::row(block));
      states.push_back(Snapshot::row(block) + 1);
    }
  }
  return states;
}

std::vector<int> culprits(const Transition& t, const ProbedChange& change, const SpanBasis& basis,
                          int most) {
  const auto rows_left = [&](const std::vector<int>& blocks) {
    return basis.W.rows() - static_cast<Eigen::Index>(statesOf(blocks).size());
  };
  if (basis.begin == 0 && rows_left({-1}) > basis.W.cols() &&
      fitSpan(t, change, basis, statesOf({-1})).whole) {
    return {-1};
  }
  const std::vector<int> grown = growingFeatures(t);  // beyond doubt
  std::vector<int> found = grown;
  if (static_cast<int>(found.size()) > most) return {};
  SpanFit fit = fitSpan(t, change, basis, statesOf(found));
  while (!fit.whole && static_cast<int>(found.size()) < most) {
    const OrthonormalSpan f = orthonormal(basis, statesOf(found));
    int best = -1;
    double best_relief = 0.0;
    for (int i = 0; i < t.shared; ++i) {
      if (std::find(found.begin(), found.end(), i) != found.end()) continue;
      const double gain = relief(f.Q, fit.outside, Snapshot::row(i) - basis.begin, 2);
      if (gain > best_relief) {
        best_relief = gain;
        best = i;
      }
    }
    if (best < 0) break;
    found.push_back(best);
    if (rows_left(found) < basis.W.cols() + 3) break;  // too few rows to prove anything
    fit = fitSpan(t, change, basis, statesOf(found));
  }
  if (!fit.whole) return grown;
  for (std::size_t k = grown.size(); k < found.size() && found.size() > 1;) {  // each one needed?
    std::vector<int> fewer = found;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (fitSpan(t, change, basis, statesOf(fewer)).whole) {
      found = std::move(fewer);
    } else {
      ++k;
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace slamscope::slam
