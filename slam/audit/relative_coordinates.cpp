// SPDX-License-Identifier: MIT
#include "slam/audit/relative_coordinates.hpp"

#include <cmath>

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

/// A Bᵀ into `half`, column by column, and B A Bᵀ into columns that are `stride` apart. A:
/// (3 + size)², symmetric.
SLAMSCOPE_FMA_CLONES
void projectColumns(const double* A, std::ptrdiff_t size, const double* lever, double* half,
                    double* projected, std::ptrdiff_t stride) {
  const std::ptrdiff_t rows = 3 + size;
  const double* const heading = A + 2 * rows;
  for (std::ptrdiff_t m = 0; m < size; ++m) {
    const double* const feature = A + (3 + m) * rows;
    const double* const robot = A + (m % 2) * rows;
    double* __restrict const z = half + m * rows;
    for (std::ptrdiff_t i = 0; i < rows; ++i) z[i] = feature[i] - robot[i] + lever[m] * heading[i];
    double* __restrict const out = projected + m * stride;
    for (std::ptrdiff_t i = 0; i < size; i += 2) {
      out[i] = z[3 + i] - z[0] + lever[i] * z[2];
      out[i + 1] = z[4 + i] - z[1] + lever[i + 1] * z[2];
    }
  }
}

}  // namespace

void RelativeCoordinates::take(const Transition& t) {
  deltas_.clear();
  const auto size = 2 * static_cast<Eigen::Index>(t.observed.size());
  lever_.resize(size);
  sigma_.resize(size);
  for (Eigen::Index m = 0; m < size; m += 2) {
    const int i = t.observed[static_cast<std::size_t>(m / 2)];
    const Eigen::Vector2d delta =
        t.before->features[static_cast<std::size_t>(i)] - t.before->pose.head<2>();
    deltas_.push_back(delta);
    lever_[m] = delta.y();
    lever_[m + 1] = -delta.x();
    sigma_.segment<2>(m) = t.sigma.segment<2>(Snapshot::row(i)) + t.sigma.head<2>() +
                           t.sigma[2] * lever_.segment<2>(m).cwiseAbs();
  }
}

void RelativeCoordinates::project(const Eigen::MatrixXd& A, SmallMatrix& projected) {
  half_projected_.resize(A.rows(), size());
  projected.resize(size());
  projectColumns(A.data(), size(), lever_.data(), half_projected_.data(), projected.column(0),
                 projected.stride());
}

void RelativeCoordinates::project(const FourColumns& vectors, FourColumns& projected) const {
  projected.resize(4, size());
  for (Eigen::Index m = 0; m < size(); ++m) {
    projected.col(m) = vectors.col(3 + m) - vectors.col(m % 2) + lever_[m] * vectors.col(2);
  }
}

void RelativeCoordinates::lift(const FourColumns& vectors, FourColumns& lifted) const {
  lifted.setZero(4, 3 + size());
  for (Eigen::Index m = 0; m < size(); ++m) {
    lifted.col(3 + m) = vectors.col(m);
    lifted.col(m % 2) -= vectors.col(m);
    lifted.col(2) += lever_[m] * vectors.col(m);
  }
}

}  // namespace slamscope::slam
