// SPDX-License-Identifier: MIT
#include "slam/audit/tall_comparison.hpp"

#include <algorithm>

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

/// largest ← the larger of it and |v|, entry by entry.
[[gnu::always_inline]] inline void raise(Vector4& largest, const Vector4& v) {
  const Vector4 size = v < 0.0 ? -v : v;
  largest = largest > size ? largest : size;
}

[[gnu::always_inline]] inline double largestOf(const Vector4& v) {
  return std::max(std::max(v[0], v[1]), std::max(v[2], v[3]));
}

/// Eight rows at a time, their sums in registers.
SLAMSCOPE_FMA_CLONES
void compareRows(const double* columns, std::ptrdiff_t rows, std::ptrdiff_t count,
                 const double* weights, const double* tall, double* largest) {
  Vector4 whole[kComparedImages]{}, outside[kComparedImages]{};
  for (std::ptrdiff_t row = 0; row < rows; row += 8) {
    Vector4 sum[2][kComparedImages]{};
    for (std::ptrdiff_t q = 0; q < count; ++q) {
      const double* const from = columns + q * rows + row;
      const Vector4 first = vector4At(from), second = vector4At(from + 4);
      for (int k = 0; k < kComparedImages; ++k) {
        sum[0][k] += weights[4 * q + k] * first;
        sum[1][k] += weights[4 * q + k] * second;
      }
    }
    for (int half = 0; half < 2; ++half) {
      const double* const from = tall + row + 4 * half;
      const Vector4 scale = vector4At(from + kComparedImages * rows);
      for (int k = 0; k < kComparedImages; ++k) {
        const Vector4 y = vector4At(from + k * rows);
        raise(whole[k], scale * y);
        raise(outside[k], scale * (y - sum[half][k]));
      }
    }
  }
  for (int k = 0; k < kComparedImages; ++k) {
    largest[2 * k] = largestOf(whole[k]);
    largest[2 * k + 1] = largestOf(outside[k]);
  }
}

}  // namespace

void compareTall(const Eigen::MatrixXd& columns, const FourColumns& weights,
                 const Eigen::MatrixXd& tall, Eigen::Array2Xd& largest) {
  largest.resize(2, kComparedImages);
  compareRows(columns.data(), columns.rows(), columns.cols(), weights.data(), tall.data(),
              largest.data());
}

}  // namespace slamscope::slam
