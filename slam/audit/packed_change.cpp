// SPDX-License-Identifier: MIT
#include "slam/audit/packed_change.hpp"

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

[[gnu::always_inline]] inline double sumOf(const Vector4& v) {
  return (v[0] + v[1]) + (v[2] + v[3]);
}

[[gnu::always_inline]] inline const Vector4& at(const double* place) {
  return *reinterpret_cast<const Vector4*>(place);
}

[[gnu::always_inline]] inline Vector4& at(double* place) {
  return *reinterpret_cast<Vector4*>(place);
}

/// One row: columns before the diagonal, and the diagonal.
[[gnu::always_inline]] inline void addRow(const double* a, const double* b, std::ptrdiff_t i,
                                          const TwoImages& x) {
  Vector4 of_w{}, of_v{};
  const double w = x.w[i], v = x.v[i];
  std::ptrdiff_t j = 0;
  for (; j + 4 <= i; j += 4) {
    const Vector4 d = at(a + j) - at(b + j);
    of_w += d * at(x.w + j), of_v += d * at(x.v + j);
    at(x.of_w + j) += w * d, at(x.of_v + j) += v * d;
  }
  double sum_w = sumOf(of_w), sum_v = sumOf(of_v);
  for (; j < i; ++j) {
    const double d = a[j] - b[j];
    sum_w += d * x.w[j], sum_v += d * x.v[j];
    x.of_w[j] += d * w, x.of_v[j] += d * v;
  }
  const double d = a[i] - b[i];
  x.of_w[i] += sum_w + d * w, x.of_v[i] += sum_v + d * v;
}

/// Rows i and i + 1 up to column i − 1: half the loads and stores of the vectors and images.
[[gnu::always_inline]] inline void addTwoRows(const PackedChange& D, std::ptrdiff_t i,
                                              const TwoImages& x) {
  const double* const a = D.rowBefore(i);
  const double* const b = D.rowAfter(i);
  const double* const a2 = D.rowBefore(i + 1);
  const double* const b2 = D.rowAfter(i + 1);
  const double w = x.w[i], v = x.v[i], w2 = x.w[i + 1], v2 = x.v[i + 1];
  Vector4 of_w{}, of_v{}, of_w2{}, of_v2{};
  std::ptrdiff_t j = 0;
  for (; j + 4 <= i; j += 4) {
    const Vector4 d = at(a + j) - at(b + j), d2 = at(a2 + j) - at(b2 + j);
    const Vector4 w_j = at(x.w + j), v_j = at(x.v + j);
    of_w += d * w_j, of_v += d * v_j, of_w2 += d2 * w_j, of_v2 += d2 * v_j;
    at(x.of_w + j) += w * d + w2 * d2, at(x.of_v + j) += v * d + v2 * d2;
  }
  double sum_w = sumOf(of_w), sum_v = sumOf(of_v), sum_w2 = sumOf(of_w2), sum_v2 = sumOf(of_v2);
  for (; j < i; ++j) {
    const double d = a[j] - b[j], d2 = a2[j] - b2[j];
    sum_w += d * x.w[j], sum_v += d * x.v[j], sum_w2 += d2 * x.w[j], sum_v2 += d2 * x.v[j];
    x.of_w[j] += d * w + d2 * w2, x.of_v[j] += d * v + d2 * v2;
  }
  // The corner: D(i, i), D(i + 1, i), D(i + 1, i + 1).
  const double d = a[i] - b[i], d21 = a2[i] - b2[i], d22 = a2[i + 1] - b2[i + 1];
  x.of_w[i] += sum_w + d * w + d21 * w2, x.of_v[i] += sum_v + d * v + d21 * v2;
  x.of_w[i + 1] += sum_w2 + d21 * w + d22 * w2, x.of_v[i + 1] += sum_v2 + d21 * v + d22 * v2;
}

}  // namespace

SLAMSCOPE_FMA_CLONES
void addImages(const PackedChange& D, std::ptrdiff_t first, std::ptrdiff_t last,
               const TwoImages& images) {
  std::ptrdiff_t i = first;
  for (; i + 2 <= last; i += 2) addTwoRows(D, i, images);
  if (i < last) addRow(D.rowBefore(i), D.rowAfter(i), i, images);
}

}  // namespace slamscope::slam
