// SPDX-License-Identifier: MIT
// Eigen's decompositions of the sizes used here, and the kernels of its products and triangular
// solves, declared once for all: each costs up to four seconds of compile time in every file that
// instantiates it, and eigen_templates.cpp does it for all of them (small matrices take the
// eigenvalues of MatrixXd too). Part of the precompiled headers; code built without it only
// compiles longer. The kernels are Eigen 3.4's own; another version may need other ones.
#pragma once

#include <Eigen/Dense>

namespace slamscope::eigen_kernels {

using Columns = Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>;
using Rows = Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>;
using Result = Eigen::internal::blas_data_mapper<double, Eigen::Index, Eigen::ColMajor, 0, 1>;
using Traits = Eigen::internal::gebp_traits<double, double>;

}  // namespace slamscope::eigen_kernels

// The parameters are declarations and types, where parentheses cannot stand.
// NOLINTBEGIN(bugprone-macro-parentheses)
// clang-format off
#define SLAMSCOPE_EIGEN_COMPUTE(declared, Solver, ...)                                             \
  declared template Eigen::Solver& Eigen::Solver::compute(__VA_ARGS__)
#define SLAMSCOPE_EIGEN_TEMPLATES(declared)                                                        \
  SLAMSCOPE_EIGEN_COMPUTE(declared, LLT<Eigen::MatrixXd>, const Eigen::EigenBase<Eigen::MatrixXd>&); \
  SLAMSCOPE_EIGEN_COMPUTE(declared, LLT<Eigen::Matrix2d>, const Eigen::EigenBase<Eigen::Matrix2d>&); \
  SLAMSCOPE_EIGEN_COMPUTE(declared, SelfAdjointEigenSolver<Eigen::MatrixXd>,                       \
                          const Eigen::EigenBase<Eigen::MatrixXd>&, int);                          \
  declared template void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::computeInPlace()
#define SLAMSCOPE_EIGEN_TIMES_VECTOR(declared, Order, Matrix, Vector)                              \
  declared template struct Eigen::internal::general_matrix_vector_product<                         \
      Eigen::Index, double, slamscope::eigen_kernels::Matrix, Eigen::Order, false, double,         \
      slamscope::eigen_kernels::Vector, false, 0>
#define SLAMSCOPE_EIGEN_SOLVE(declared, Side, Half, Order)                                         \
  declared template struct Eigen::internal::triangular_solve_matrix<                               \
      double, Eigen::Index, Eigen::Side, Eigen::Half, false, Eigen::Order, Eigen::ColMajor, 1>
#define SLAMSCOPE_EIGEN_KERNELS(declared)                                                          \
  declared template struct Eigen::internal::gebp_kernel<                                           \
      double, double, Eigen::Index, slamscope::eigen_kernels::Result,                              \
      slamscope::eigen_kernels::Traits::mr, slamscope::eigen_kernels::Traits::nr, false, false>;   \
  SLAMSCOPE_EIGEN_TIMES_VECTOR(declared, ColMajor, Columns, Rows);                                 \
  SLAMSCOPE_EIGEN_TIMES_VECTOR(declared, RowMajor, Rows, Columns);                                 \
  SLAMSCOPE_EIGEN_SOLVE(declared, OnTheLeft, Lower, ColMajor);                                     \
  SLAMSCOPE_EIGEN_SOLVE(declared, OnTheLeft, Upper, ColMajor);                                     \
  SLAMSCOPE_EIGEN_SOLVE(declared, OnTheLeft, Upper, RowMajor);                                     \
  SLAMSCOPE_EIGEN_SOLVE(declared, OnTheRight, Upper, RowMajor)
// clang-format on
// NOLINTEND(bugprone-macro-parentheses)

SLAMSCOPE_EIGEN_TEMPLATES(extern);
SLAMSCOPE_EIGEN_KERNELS(extern);
