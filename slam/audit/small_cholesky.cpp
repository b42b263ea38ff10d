// SPDX-License-Identifier: MIT
#include "slam/audit/small_cholesky.hpp"

#include <cmath>

#include "slam/vector4.hpp"

namespace slamscope::slam {
namespace {

/// X ← L⁻¹ X for 4 Width columns whose rows are `stride` apart and zero before row `begin`.
template <int Width>
[[gnu::always_inline]] inline void forwardBlock(const double* L, std::ptrdiff_t size,
                                                std::ptrdiff_t L_stride, double* X,
                                                std::ptrdiff_t stride, std::ptrdiff_t begin) {
  for (std::ptrdiff_t i = begin; i < size; ++i) {
    Vector4 sum[Width];
    for (int k = 0; k < Width; ++k) sum[k] = vector4At(X + i * stride + 4 * k);
    for (std::ptrdiff_t j = begin; j < i; ++j) {
      const double l = L[j * L_stride + i];
      for (int k = 0; k < Width; ++k) sum[k] -= l * vector4At(X + j * stride + 4 * k);
    }
    const double inverse = 1.0 / L[i * L_stride + i];
    for (int k = 0; k < Width; ++k) vector4At(X + i * stride + 4 * k) = inverse * sum[k];
  }
}

/// Column j of the factor, once nothing is to be taken from it any more. False: no root.
[[gnu::always_inline]] inline bool finish(double* column, std::ptrdiff_t stride, std::ptrdiff_t j) {
  if (!(column[j] > 0.0)) return false;
  const double inverse = 1.0 / std::sqrt(column[j]);
  // From the four that hold the diagonal on: what is above it may become anything.
  for (std::ptrdiff_t i = j / 4 * 4; i < stride; i += 4) vector4At(column + i) *= inverse;
  return true;
}

/// Columns j and j + 1 of the factor, and what they take from those after them.
[[gnu::always_inline]] inline bool eliminate(double* A, std::ptrdiff_t size, std::ptrdiff_t stride,
                                             std::ptrdiff_t j) {
  double* const first = A + j * stride;
  if (!finish(first, stride, j)) return false;
  if (j + 1 == size) return true;
  double* const second = first + stride;
  const double between = first[j + 1];
  for (std::ptrdiff_t i = (j + 1) / 4 * 4; i < stride; i += 4) {
    vector4At(second + i) -= between * vector4At(first + i);
  }
  if (!finish(second, stride, j + 1)) return false;
  for (std::ptrdiff_t k = j + 2; k < size; ++k) {
    double* const other = A + k * stride;
    const double of_first = first[k], of_second = second[k];
    for (std::ptrdiff_t i = k / 4 * 4; i < stride; i += 4) {
      vector4At(other + i) -= of_first * vector4At(first + i) + of_second * vector4At(second + i);
    }
  }
  return true;
}

SLAMSCOPE_FMA_CLONES
void factoriseColumns(double* A, double* B, std::ptrdiff_t size, std::ptrdiff_t stride,
                      Factorised& regular) {
  regular = {true, B != nullptr};
  for (std::ptrdiff_t j = 0; j < size; j += 2) {
    regular.first = regular.first && eliminate(A, size, stride, j);
    regular.second = regular.second && eliminate(B, size, stride, j);
  }
}

SLAMSCOPE_FMA_CLONES
void solveFourColumns(const double* L, std::ptrdiff_t size, std::ptrdiff_t stride, double* X) {
  for (std::ptrdiff_t j = 0; j < size; ++j) {
    const double* const column = L + j * stride;
    const Vector4 x = vector4At(X + 4 * j) * (1.0 / column[j]);
    vector4At(X + 4 * j) = x;
    for (std::ptrdiff_t i = j + 1; i < size; ++i) vector4At(X + 4 * i) -= column[i] * x;
  }
  for (std::ptrdiff_t j = size - 1; j >= 0; --j) {
    const double* const column = L + j * stride;
    Vector4 even = vector4At(X + 4 * j), odd{};
    std::ptrdiff_t i = j + 1;
    for (; i + 2 <= size; i += 2) {
      even -= column[i] * vector4At(X + 4 * i);
      odd -= column[i + 1] * vector4At(X + 4 * (i + 1));
    }
    if (i < size) even -= column[i] * vector4At(X + 4 * i);
    vector4At(X + 4 * j) = (even + odd) * (1.0 / column[j]);
  }
}

SLAMSCOPE_FMA_CLONES
void solveForwardRows(const double* L, std::ptrdiff_t size, std::ptrdiff_t L_stride, double* X,
                      std::ptrdiff_t columns, std::ptrdiff_t identity) {
  std::ptrdiff_t first = 0;
  const auto begin = [&] { return first > identity ? first - identity : 0; };
  for (; first + 16 <= columns; first += 16) {
    forwardBlock<4>(L, size, L_stride, X + first, columns, begin());
  }
  for (; first < columns; first += 4) {
    forwardBlock<1>(L, size, L_stride, X + first, columns, begin());
  }
}

SLAMSCOPE_FMA_CLONES
void addSquares(const double* X, std::ptrdiff_t rows, std::ptrdiff_t columns, std::ptrdiff_t column,
                double* squares, double* along) {
  for (std::ptrdiff_t i = 0; i < rows; ++i) {
    const double* const row = X + i * columns;
    for (std::ptrdiff_t m = 0; m < columns; m += 4) {
      const Vector4 x = vector4At(row + m);
      vector4At(squares + m) += x * x;
      vector4At(along + m) += row[column] * x;
    }
  }
}

}  // namespace

void SmallMatrix::resize(Eigen::Index size) {
  if (size == size_) return;
  size_ = size;
  numbers_.setZero((size + 3) / 4 * 4, size);
}

bool factorise(SmallMatrix& A) {
  Factorised regular;
  factoriseColumns(A.column(0), nullptr, A.size(), A.stride(), regular);
  return regular.first;
}

Factorised factoriseBoth(SmallMatrix& A, SmallMatrix& B) {
  Factorised regular;
  factoriseColumns(A.column(0), B.column(0), A.size(), A.stride(), regular);
  return regular;
}

void squaresOf(const ManyColumns& X, Eigen::Index column, Eigen::VectorXd& squares,
               Eigen::VectorXd& along) {
  squares.setZero(X.cols());
  along.setZero(X.cols());
  addSquares(X.data(), X.rows(), X.cols(), column, squares.data(), along.data());
}

Resolved squaredOverResolved(SmallMatrix& A, Eigen::VectorXd& v, double least) {
  Resolved resolved;
  while (resolved.rank < A.size()) {
    Eigen::Index pivot = 0;
    for (Eigen::Index i = 1; i < A.size(); ++i) {
      if (A(i, i) > A(pivot, pivot)) pivot = i;
    }
    if (!(A(pivot, pivot) > least)) break;
    ++resolved.rank;
    resolved.squared += v[pivot] * v[pivot] / A(pivot, pivot);
    const Eigen::VectorXd column =
        Eigen::Map<const Eigen::VectorXd>(A.column(pivot), A.size()) / A(pivot, pivot);
    v -= v[pivot] * column;
    for (Eigen::Index i = 0; i < A.size(); ++i) {
      Eigen::Map<Eigen::VectorXd>(A.column(i), A.size()) -= A(pivot, i) * column;
    }
  }
  return resolved;
}

void solveFour(const SmallMatrix& L, FourColumns& X) {
  solveFourColumns(L.column(0), L.size(), L.stride(), X.data());
}

void solveForward(const SmallMatrix& L, ManyColumns& X, Eigen::Index identity) {
  solveForwardRows(L.column(0), L.size(), L.stride(), X.data(), X.cols(), identity);
}

}  // namespace slamscope::slam
