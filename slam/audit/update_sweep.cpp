// SPDX-License-Identifier: MIT
#include "slam/audit/update_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/helper_thread.hpp"

namespace slamscope::slam {
namespace {

/// So many rows are taken before their entries are gathered: they are still in the cache then.
constexpr std::ptrdiff_t kRowsTogether = 16;
/// Rows from which a second thread pays: it is awake after some 10 µs.
constexpr std::ptrdiff_t kWorthTwoThreads = 700;

}  // namespace

UpdateSweep::UpdateSweep() = default;
UpdateSweep::~UpdateSweep() = default;

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
  columns_.resize(padded(size), count);
  columns_.bottomRows(padded(size) - size).setZero();
  block_before_.resize(count, count);
  block_of_change_.resize(count, count);
  diagonal_.resize(size);
  beside_diagonal_.resize(size);
}

void UpdateSweep::gather(const double* before, const double* after, int row, Part& part) {
  diagonal_[row] = before[row] - after[row];
  beside_diagonal_[row] = row > 0 ? before[row - 1] - after[row - 1] : 0.0;
  part.least_variance = std::min(part.least_variance, after[row]);
  const auto count = static_cast<Eigen::Index>(part.next_state);
  double* const to = columns_.data() + row;
  for (Eigen::Index q = 0; q < count; ++q) {  // columns left of the diagonal
    to[q * columns_.rows()] = before[states_[static_cast<std::size_t>(q)]];
  }
  if (part.next_state == states_.size() || states_[part.next_state] != row) return;
  // This row is a column too, down to the diagonal.
  columns_.col(count).head(row + 1) = Eigen::Map<const Eigen::VectorXd>(before, row + 1);
  for (Eigen::Index q = 0; q <= count; ++q) {
    const int state = states_[static_cast<std::size_t>(q)];
    block_before_(count, q) = block_before_(q, count) = before[state];
    block_of_change_(count, q) = block_of_change_(q, count) = before[state] - after[state];
  }
  ++part.next_state;
}

void UpdateSweep::takeRows(const PackedChange& D, std::ptrdiff_t begin, std::ptrdiff_t end,
                           Part& part) {
  part.image.setZero(padded(diagonal_.size()));
  part.least_variance = std::numeric_limits<double>::infinity();
  const auto next = std::lower_bound(states_.begin(), states_.end(), static_cast<int>(begin));
  part.next_state = static_cast<std::size_t>(next - states_.begin());
  for (std::ptrdiff_t first = begin; first < end; first += kRowsTogether) {
    const std::ptrdiff_t last = std::min(first + kRowsTogether, end);
    addImage(D, first, last, scaled_omega_.data(), part.image.data());
    for (std::ptrdiff_t row = first; row < last; ++row) {
      gather(D.rowBefore(row), D.rowAfter(row), static_cast<int>(row), part);
    }
  }
}

void UpdateSweep::take(const Transition& t) {
  resize(t);
  const PackedChange D{t.before->covariance.packed().data(), t.after->covariance.packed().data()};
  const std::ptrdiff_t size = t.size();
  if (size < kWorthTwoThreads) {
    takeRows(D, 0, size, parts_[0]);
  } else {
    if (!helper_) helper_ = std::make_unique<HelperThread>();
    // Half of the triangle lies above this row.
    const auto middle = static_cast<std::ptrdiff_t>(std::sqrt(0.5) * static_cast<double>(size));
    helper_->share([&] { takeRows(D, middle, size, parts_[0]); },
                   [&] { takeRows(D, 0, middle, parts_[1]); });
    parts_[0].image += parts_[1].image;
    parts_[0].least_variance = std::min(parts_[0].least_variance, parts_[1].least_variance);
  }
  finite_ = (parts_[0].image.array() * 0.0).sum() == 0.0;
}

}  // namespace slamscope::slam
