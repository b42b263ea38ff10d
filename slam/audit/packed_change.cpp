// SPDX-License-Identifier: MIT
#include "slam/audit/packed_change.hpp"

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

/// So many rows share what is fetched and stored of w and its image: with four of them the sums
/// stay in registers.
constexpr int kRows = 4;

[[gnu::always_inline]] inline double sumOf(const Vector4& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

/// Rows i … i + Rows − 1 with all of their columns.
template <int Rows>
[[gnu::always_inline]] inline void addRows(const PackedChange& D, std::ptrdiff_t i, const double* w,
                                           double* image) {
  const double* a[Rows];
  const double* b[Rows];
  double own[Rows], sum[Rows];
  Vector4 sums[Rows]{};
  for (int k = 0; k < Rows; ++k) {
    a[k] = D.rowBefore(i + k);
    b[k] = D.rowAfter(i + k);
    own[k] = w[i + k];
  }
  std::ptrdiff_t j = 0;
  for (; j + 4 <= i; j += 4) {
    const Vector4 w_j = vector4At(w + j);
    Vector4 image_j = vector4At(image + j);
    for (int k = 0; k < Rows; ++k) {
      const Vector4 d = vector4At(a[k] + j) - vector4At(b[k] + j);
      sums[k] += d * w_j;
      image_j += own[k] * d;
    }
    vector4At(image + j) = image_j;
  }
  for (int k = 0; k < Rows; ++k) sum[k] = sumOf(sums[k]);
  for (; j < i + Rows; ++j) {  // the last columns, those of the rows themselves among them
    for (int k = 0; k < Rows; ++k) {
      if (j > i + k) continue;
      const double d = a[k][j] - b[k][j];
      sum[k] += d * w[j];
      if (j < i + k) image[j] += d * own[k];
    }
  }
  for (int k = 0; k < Rows; ++k) image[i + k] += sum[k];
}

}  // namespace

SLAMSCOPE_FMA_CLONES
void addImage(const PackedChange& D, std::ptrdiff_t first, std::ptrdiff_t last, const double* w,
              double* image) {
  std::ptrdiff_t i = first;
  for (; i + kRows <= last; i += kRows) addRows<kRows>(D, i, w, image);
  for (; i < last; ++i) addRows<1>(D, i, w, image);
}

}  // namespace slamscope::slam
