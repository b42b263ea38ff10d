// SPDX-License-Identifier: MIT
#include "slam/ekf_cholesky.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

constexpr std::ptrdiff_t kFactorRows = 64;  // larger factors go Eigen's way

/// Columns of `A`, `stride` doubles apart (a multiple of four), become those of L. Each takes its
/// part from all that follow as it stands, divided by its pivot: roots come last, all at once, so
/// that none is waited for.
SLAMSCOPE_FMA_CLONES
bool factorise(double* A, std::ptrdiff_t m, std::ptrdiff_t stride) {
  double pivots[kFactorRows];
  for (std::ptrdiff_t j = 0; j < m; ++j) {
    double* const column = A + j * stride;
    const double pivot = column[j];
    // Written so that NaN fails; what is not finite below the diagonal makes a later pivot fail.
    if (!(pivot > 0.0 && pivot <= std::numeric_limits<double>::max())) return false;
    pivots[j] = pivot;
    const double inverse = 1.0 / pivot;
    for (std::ptrdiff_t c = j + 1; c < m; ++c) {
      const double factor = column[c] * inverse;
      double* const other = A + c * stride;
      for (std::ptrdiff_t row = c / 4 * 4; row < stride; row += 4) {
        vector4At(other + row) -= vector4At(column + row) * factor;
      }
    }
  }
  for (std::ptrdiff_t j = 0; j < m; ++j) {
    double* const column = A + j * stride;
    const double root = std::sqrt(pivots[j]);
    const double inverse = 1.0 / root;
    for (std::ptrdiff_t row = j / 4 * 4; row < stride; row += 4) vector4At(column + row) *= inverse;
    column[j] = root;
  }
  return true;
}

/// Of four rows a panel: enough sums to keep the multipliers busy, as each waits for itself; and
/// the 33 rows of fifteen features are one panel.
constexpr int kMostVectors = 9;
constexpr std::ptrdiff_t kPanelCols = 128;  // wider ones go Eigen's way

/// Forward substitution of a panel's rows, four to a vector, column by column:
/// y_j = (b_j − Σ_{k<j} y_k L_jk) / L_jj.
template <int kVectors>
[[gnu::always_inline]] inline void solveVectors(const double* L, std::ptrdiff_t m, Vector4* panel) {
  for (std::ptrdiff_t j = 0; j < m; ++j) {
    Vector4* const y = panel + j * kVectors;
    Vector4 sum[kVectors];
#pragma GCC unroll 16
    for (int v = 0; v < kVectors; ++v) sum[v] = y[v];
    for (std::ptrdiff_t k = 0; k < j; ++k) {
      const Vector4* const known = panel + k * kVectors;
      const double factor = L[k * m + j];
#pragma GCC unroll 16
      for (int v = 0; v < kVectors; ++v) sum[v] -= known[v] * factor;
    }
    const double inverse = 1.0 / L[j * m + j];
#pragma GCC unroll 16
    for (int v = 0; v < kVectors; ++v) y[v] = sum[v] * inverse;
  }
}

template <int kVectors>
[[gnu::always_inline]] inline void solveAtMost(const double* L, std::ptrdiff_t m, Vector4* panel,
                                               std::ptrdiff_t vectors) {
  if constexpr (kVectors > 1) {
    if (vectors < kVectors) return solveAtMost<kVectors - 1>(L, m, panel, vectors);
  }
  solveVectors<kVectors>(L, m, panel);
}

SLAMSCOPE_FMA_CLONES
void solvePanel(const double* L, std::ptrdiff_t m, Vector4* panel, std::ptrdiff_t vectors) {
  solveAtMost<kMostVectors>(L, m, panel, vectors);
}

/// Rows `row` … `row` + `rows` − 1.
void solveRows(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B, std::ptrdiff_t row,
               std::ptrdiff_t rows, Eigen::MatrixXd& Y) {
  alignas(32) double panel[4 * kMostVectors * kPanelCols];
  const std::ptrdiff_t size = B.rows();
  const std::ptrdiff_t m = B.cols();
  const std::ptrdiff_t vectors = (rows + 3) / 4;
  for (std::ptrdiff_t k = 0; k < m; ++k) {
    double* const column = panel + k * 4 * vectors;
    std::copy_n(B.data() + k * size + row, rows, column);
    std::fill_n(column + rows, 4 * vectors - rows, 0.0);
  }
  solvePanel(L.data(), m, reinterpret_cast<Vector4*>(panel), vectors);
  for (std::ptrdiff_t k = 0; k < m; ++k) {
    std::copy_n(panel + k * 4 * vectors, rows, Y.data() + k * size + row);
  }
}

}  // namespace

bool choleskyOf(const Eigen::MatrixXd& S, Eigen::MatrixXd& L) {
  const std::ptrdiff_t m = S.rows();
  if (m > kFactorRows) {
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    if (factor.info() != Eigen::Success || !S.allFinite()) return false;
    L = factor.matrixLLT();
    return true;
  }
  alignas(32) double A[kFactorRows * kFactorRows];
  const std::ptrdiff_t stride = (m + 3) / 4 * 4;
  Eigen::Map<Eigen::MatrixXd, Eigen::Aligned32> padded(A, stride, m);
  padded.topRows(m) = S;
  padded.bottomRows(stride - m).setZero();
  if (!factorise(A, m, stride)) return false;
  L = padded.topRows(m);
  return true;
}

void solveFromTheRight(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B, Eigen::MatrixXd& Y) {
  const std::ptrdiff_t size = B.rows();
  if (B.cols() > kPanelCols) {
    Y = B;
    L.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(Y);
    return;
  }
  Y.resize(size, B.cols());
  constexpr std::ptrdiff_t kPanelRows = 4 * (kMostVectors - 1);
  std::ptrdiff_t row = 0;
  for (; size - row > 4 * kMostVectors; row += kPanelRows) solveRows(L, B, row, kPanelRows, Y);
  solveRows(L, B, row, size - row, Y);
}

}  // namespace slamscope::slam
