// SPDX-License-Identifier: MIT
#include "slam/audit/change_range.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "slam/audit/thin_q.hpp"

namespace slamscope::slam {
namespace {

/// What is outside of the range, and how large it may be from noise alone.
double outside(const ChangeRange& range, const Eigen::VectorXd& v) {
  return (v - range.Q * (range.Q.transpose() * v)).norm();
}

}  // namespace

ChangeRange rangeOfChange(const Transition& t, int rank, int most) {
  ChangeRange range;
  const int limit = std::min(most, t.size());
  for (int count = std::min(rank + 3, limit);; count = std::min(2 * count, limit)) {
    const ProbedChange change = probeChange(t, 0, count);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(change.Y);
    const auto& R = qr.matrixR();
    const double drowned = 10.0 * t.noise * std::sqrt(static_cast<double>(t.size()) * t.size()) +
                           1e-9 * std::abs(R(0, 0));
    Eigen::Index r = 0;
    while (r < count && std::abs(R(r, r)) > drowned) ++r;
    range.complete = r < count;
    range.Q = thinQ(qr, r);
    range.noise = r > 0 ? drowned / std::abs(R(r - 1, r - 1)) : 0.0;
    if (range.complete || count >= limit) return range;
  }
}

std::optional<Eigen::Vector2d> linearisedAt(const Transition& t, const ChangeRange& range,
                                            int written) {
  const int row = Snapshot::row(written);
  const Eigen::VectorXd theta = t.scaledColumn(2);
  const Eigen::VectorXd a = t.scaledColumn(row) - t.scaledColumn(0);
  const Eigen::VectorXd b = t.scaledColumn(row + 1) - t.scaledColumn(1);
  const auto off = [&](const Eigen::VectorXd& v) {
    return Eigen::VectorXd(v - range.Q * (range.Q.transpose() * v));
  };
  const Eigen::VectorXd h = off(theta);
  const double size = h.squaredNorm();
  if (!(h.norm() > (1e-6 + 10.0 * range.noise) * theta.norm())) return std::nullopt;
  const Eigen::VectorXd a_off = off(a);
  const Eigen::VectorXd b_off = off(b);
  // Columns of P⁻Bᵀ: a + δ_y θ and b − δ_x θ.
  const Eigen::Vector2d delta(b_off.dot(h) / size, -a_off.dot(h) / size);
  const double rest = (a_off + delta.y() * h).norm() + (b_off - delta.x() * h).norm();
  if (rest > (1e-5 + 10.0 * range.noise) * (a.norm() + b.norm())) return std::nullopt;
  return delta;
}

double shareOutside(const Transition& t, const ChangeRange& range, int feature,
                    const Eigen::Vector2d& delta) {
  const int row = Snapshot::row(feature);
  const Eigen::VectorXd theta = t.scaledColumn(2);
  const Eigen::VectorXd u = t.scaledColumn(row) - t.scaledColumn(0) + delta.y() * theta;
  const Eigen::VectorXd v = t.scaledColumn(row + 1) - t.scaledColumn(1) - delta.x() * theta;
  return std::max(outside(range, u) / std::max(u.norm(), 1e-300),
                  outside(range, v) / std::max(v.norm(), 1e-300));
}

bool contains(const Transition& t, const ChangeRange& range, int feature,
              const Eigen::Vector2d& delta) {
  return shareOutside(t, range, feature, delta) <= 1e-6 + 10.0 * range.noise;
}

}  // namespace slamscope::slam
