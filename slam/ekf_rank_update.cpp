// SPDX-License-Identifier: MIT
#include "slam/ekf_rank_update.hpp"

#include <algorithm>
#include <vector>

// Sanitizers run before the resolvers of multi-versioned functions may.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SLAMSCOPE_CLONES \
  __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define SLAMSCOPE_CLONES
#endif

namespace slamscope::slam {
namespace {

constexpr std::ptrdiff_t kPanel = 8;  // rows, and columns, of a tile that is kept in registers

/// Eight doubles, wherever they lie.
using Vector8 [[gnu::vector_size(64), gnu::aligned(8), gnu::may_alias]] = double;

/// `panels`: Y in panels of eight rows, each panel k by k, the last one filled up with zeros.
SLAMSCOPE_CLONES
void subtractPanels(double* P, std::ptrdiff_t size, const double* panels, std::ptrdiff_t m) {
  for (std::ptrdiff_t col = 0; col < size; col += kPanel) {
    const double* const right = panels + col * m;
    const std::ptrdiff_t cols = std::min(kPanel, size - col);
    for (std::ptrdiff_t row = col; row < size; row += kPanel) {
      const double* const left = panels + row * m;
      Vector8 sum[kPanel] = {};
      for (std::ptrdiff_t k = 0; k < m; ++k) {
        const Vector8 y = *reinterpret_cast<const Vector8*>(left + k * kPanel);
        for (std::ptrdiff_t c = 0; c < kPanel; ++c) sum[c] += y * right[k * kPanel + c];
      }
      if (row > col && row + kPanel <= size) {
        for (std::ptrdiff_t c = 0; c < kPanel; ++c) {
          *reinterpret_cast<Vector8*>(P + (col + c) * size + row) -= sum[c];
        }
        continue;
      }
      for (std::ptrdiff_t c = 0; c < cols; ++c) {  // at the diagonal or the lower edge
        for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(0, col + c - row);
             r < std::min(kPanel, size - row); ++r) {
          P[(col + c) * size + row + r] -= sum[c][r];
        }
      }
    }
  }
}

}  // namespace

void subtractOuterProduct(Eigen::MatrixXd& P, const Eigen::MatrixXd& Y) {
  const std::ptrdiff_t size = Y.rows();
  const std::ptrdiff_t m = Y.cols();
  std::vector<double> panels(static_cast<std::size_t>((size + kPanel - 1) / kPanel * kPanel * m));
  for (std::ptrdiff_t k = 0; k < m; ++k) {
    for (std::ptrdiff_t row = 0; row < size; ++row) {
      panels[static_cast<std::size_t>((row / kPanel * m + k) * kPanel + row % kPanel)] = Y(row, k);
    }
  }
  subtractPanels(P.data(), size, panels.data(), m);
}

}  // namespace slamscope::slam
