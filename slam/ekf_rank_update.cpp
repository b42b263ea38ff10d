// SPDX-License-Identifier: MIT
#include "slam/ekf_rank_update.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/helper_thread.hpp"
#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

constexpr std::ptrdiff_t kRows = 8;     // of a tile; Y is packed in panels of so many rows
constexpr std::ptrdiff_t kCols = 4;     // of a tile: its 32 sums stay in registers
constexpr std::ptrdiff_t kBlock = 128;  // rows; a multiple of kRows
/// N² m from which a second thread pays: waking it takes some 20 µs, in which one thread does this.
constexpr std::ptrdiff_t kWorthSharing = 2'000'000;

[[gnu::always_inline]] inline void take(double* out, const Vector4& low, const Vector4& high) {
  vector4At(out) -= low;
  vector4At(out + 4) -= high;
}

/// Rows `begin` … `end` − 1 of the lower triangle, `begin` a multiple of kRows. `panels`: Y in
/// panels of eight rows, each panel k by k, the last one filled up with zeros.
SLAMSCOPE_FMA_CLONES
void subtractRows(double* P, std::ptrdiff_t size, const double* panels, std::ptrdiff_t m,
                  std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t col = 0; col < end; col += kCols) {
    const double* const right = panels + col / kRows * kRows * m + col % kRows;
    for (std::ptrdiff_t row = std::max(begin, col / kRows * kRows); row < end; row += kRows) {
      const double* const left = panels + row * m;
      // Named one by one: an array of them would live in memory.
      Vector4 low0{}, low1{}, low2{}, low3{}, high0{}, high1{}, high2{}, high3{};
      for (std::ptrdiff_t k = 0; k < m; ++k) {
        const Vector4 low = vector4At(left + k * kRows);
        const Vector4 high = vector4At(left + k * kRows + 4);
        const double* const y = right + k * kRows;
        low0 += low * y[0], high0 += high * y[0];
        low1 += low * y[1], high1 += high * y[1];
        low2 += low * y[2], high2 += high * y[2];
        low3 += low * y[3], high3 += high * y[3];
      }
      double* const out = P + col * size + row;
      if (row >= col + kCols && row + kRows <= size && col + kCols <= size) {
        take(out, low0, high0);
        take(out + size, low1, high1);
        take(out + 2 * size, low2, high2);
        take(out + 3 * size, low3, high3);
        continue;
      }
      const Vector4 sums[kCols][2] = {{low0, high0}, {low1, high1}, {low2, high2}, {low3, high3}};
      for (std::ptrdiff_t c = 0; c < std::min(kCols, size - col); ++c) {
        for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(0, col + c - row);
             r < std::min(kRows, size - row); ++r) {  // at the diagonal or the lower edge
          out[c * size + r] -= sums[c][r / 4][r % 4];
        }
      }
    }
  }
}

/// Block by block: the block's part of Y is read again for every four columns.
void subtractBlocks(double* P, std::ptrdiff_t size, const double* panels, std::ptrdiff_t m,
                    std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t row = begin; row < end; row += kBlock) {
    subtractRows(P, size, panels, m, row, std::min(row + kBlock, end));
  }
}

void pack(const Eigen::MatrixXd& Y, std::vector<double>& panels) {
  const std::ptrdiff_t size = Y.rows();
  const std::ptrdiff_t m = Y.cols();
  const std::ptrdiff_t whole = size / kRows * kRows;
  const auto needed = static_cast<std::size_t>((size + kRows - 1) / kRows * kRows * m);
  if (panels.size() < needed) panels.resize(needed);
  for (std::ptrdiff_t row = 0; row < whole; row += kRows) {
    double* const panel = panels.data() + row * m;
    for (std::ptrdiff_t k = 0; k < m; ++k) {
      std::copy_n(Y.data() + k * size + row, kRows, panel + k * kRows);
    }
  }
  if (whole == size) return;
  double* const panel = panels.data() + whole * m;
  std::fill_n(panel, kRows * m, 0.0);
  for (std::ptrdiff_t k = 0; k < m; ++k) {
    std::copy_n(Y.data() + k * size + whole, size - whole, panel + k * kRows);
  }
}

}  // namespace

RankUpdate::RankUpdate() = default;
RankUpdate::~RankUpdate() = default;

void RankUpdate::subtract(Eigen::MatrixXd& P, const Eigen::MatrixXd& Y) {
  const std::ptrdiff_t size = Y.rows();
  const std::ptrdiff_t m = Y.cols();
  pack(Y, panels_);
  const auto part = [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    subtractBlocks(P.data(), size, panels_.data(), m, begin, end);
  };
  if (threads_ < 2 || size * size * m < kWorthSharing) return part(0, size);
  if (!helper_) helper_ = std::make_unique<HelperThread>();
  // Half of the triangle lies above this row.
  const auto middle =
      static_cast<std::ptrdiff_t>(std::sqrt(0.5) * static_cast<double>(size)) / kRows * kRows;
  helper_->share([&] { part(middle, size); }, [&] { part(0, middle); });
}

}  // namespace slamscope::slam
