// SPDX-License-Identifier: MIT
#include "slam/audit/update_sweep.hpp"

#include <algorithm>
#include <limits>

#include "slam/audit/packed_change.hpp"

namespace slamscope::slam {
namespace {

/// So many rows are taken before their entries are gathered: they are still in the cache then.
constexpr std::ptrdiff_t kRowsTogether = 16;

}  // namespace

void UpdateSweep::resize(const Transition& t) {
  states_.assign({0, 1, 2});
  for (const int i : t.observed) {
    states_.push_back(Snapshot::row(i));
    states_.push_back(Snapshot::row(i) + 1);
  }
  const Eigen::Index size = t.size();
  const auto count = static_cast<Eigen::Index>(states_.size());
  fillProbes(t.after->sequence, size, 1, omega_);
  scaled_omega_ = t.scale.cwiseProduct(omega_.col(0));
  image_.setZero(padded(size));
  columns_.resize(padded(size), count);
  columns_.bottomRows(padded(size) - size).setZero();
  block_before_.resize(count, count);
  block_of_change_.resize(count, count);
  diagonal_.resize(size);
  beside_diagonal_.resize(size);
}

void UpdateSweep::gather(const double* before, const double* after, int row) {
  diagonal_[row] = before[row] - after[row];
  beside_diagonal_[row] = row > 0 ? before[row - 1] - after[row - 1] : 0.0;
  least_variance_ = std::min(least_variance_, after[row]);
  const auto count = static_cast<Eigen::Index>(next_state_);
  double* const to = columns_.data() + row;
  for (Eigen::Index q = 0; q < count; ++q) {  // columns left of the diagonal
    to[q * columns_.rows()] = before[states_[static_cast<std::size_t>(q)]];
  }
  if (next_state_ == states_.size() || states_[next_state_] != row) return;
  // This row is a column too, down to the diagonal.
  columns_.col(count).head(row + 1) = Eigen::Map<const Eigen::VectorXd>(before, row + 1);
  for (Eigen::Index q = 0; q <= count; ++q) {
    const int state = states_[static_cast<std::size_t>(q)];
    block_before_(count, q) = block_before_(q, count) = before[state];
    block_of_change_(count, q) = block_of_change_(q, count) = before[state] - after[state];
  }
  ++next_state_;
}

void UpdateSweep::take(const Transition& t) {
  resize(t);
  next_state_ = 0;
  least_variance_ = std::numeric_limits<double>::infinity();
  const PackedChange D{t.before->covariance.packed().data(), t.after->covariance.packed().data()};
  const std::ptrdiff_t size = t.size();
  for (std::ptrdiff_t first = 0; first < size; first += kRowsTogether) {
    const std::ptrdiff_t last = std::min(first + kRowsTogether, size);
    addImage(D, first, last, scaled_omega_.data(), image_.data());
    for (std::ptrdiff_t row = first; row < last; ++row) {
      gather(D.rowBefore(row), D.rowAfter(row), static_cast<int>(row));
    }
  }
  finite_ = (image_.array() * 0.0).sum() == 0.0;
}

}  // namespace slamscope::slam
