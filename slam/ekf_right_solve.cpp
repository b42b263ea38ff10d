// SPDX-License-Identifier: MIT
#include "slam/ekf_right_solve.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

constexpr std::ptrdiff_t kPanelRows = 16;   // four vectors: sums that do not wait for one another
constexpr std::ptrdiff_t kPanelCols = 128;  // wider ones go Eigen's way

/// Forward substitution of sixteen rows, column by column: y_j = (b_j − Σ_{k<j} y_k L_jk) / L_jj.
SLAMSCOPE_FMA_CLONES
void solvePanel(const double* L, std::ptrdiff_t m, double* panel) {
  for (std::ptrdiff_t j = 0; j < m; ++j) {
    auto* const y = reinterpret_cast<Vector4*>(panel + j * kPanelRows);
    Vector4 a = y[0], b = y[1], c = y[2], d = y[3];
    for (std::ptrdiff_t k = 0; k < j; ++k) {
      const auto* const known = reinterpret_cast<const Vector4*>(panel + k * kPanelRows);
      const double factor = L[k * m + j];
      a -= known[0] * factor, b -= known[1] * factor;
      c -= known[2] * factor, d -= known[3] * factor;
    }
    const double inverse = 1.0 / L[j * m + j];
    y[0] = a * inverse, y[1] = b * inverse, y[2] = c * inverse, y[3] = d * inverse;
  }
}

/// Rows `row` … `row` + `rows` − 1. With sixteen rows known when compiled, copies are a few moves.
template <typename Rows>
void solveRows(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B, std::ptrdiff_t row, Rows rows,
               Eigen::MatrixXd& Y) {
  alignas(32) double panel[kPanelRows * kPanelCols];
  const std::ptrdiff_t size = B.rows();
  const std::ptrdiff_t m = B.cols();
  for (std::ptrdiff_t k = 0; k < m; ++k) {
    double* const column = panel + k * kPanelRows;
    std::copy_n(B.data() + k * size + row, rows, column);
    std::fill_n(column + rows, kPanelRows - rows, 0.0);
  }
  solvePanel(L.data(), m, panel);
  for (std::ptrdiff_t k = 0; k < m; ++k) {
    std::copy_n(panel + k * kPanelRows, rows, Y.data() + k * size + row);
  }
}

}  // namespace

void solveFromTheRight(const Eigen::MatrixXd& L, const Eigen::MatrixXd& B, Eigen::MatrixXd& Y) {
  const std::ptrdiff_t size = B.rows();
  if (B.cols() > kPanelCols) {
    Y = B;
    L.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(Y);
    return;
  }
  Y.resize(size, B.cols());
  std::ptrdiff_t row = 0;
  for (; row + kPanelRows <= size; row += kPanelRows) {
    solveRows(L, B, row, std::integral_constant<std::ptrdiff_t, kPanelRows>(), Y);
  }
  if (row < size) solveRows(L, B, row, size - row, Y);
}

}  // namespace slamscope::slam
