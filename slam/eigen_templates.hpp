// SPDX-License-Identifier: MIT
// Eigen's decompositions of the sizes used here, declared once for all: each costs one to four
// seconds of compile time in every file that instantiates it, and eigen_templates.cpp does it for
// all of them (small matrices take the eigenvalues of MatrixXd too). Part of the precompiled
// headers; code built without it only compiles longer.
#pragma once

#include <Eigen/Dense>

// clang-format off
#define SLAMSCOPE_EIGEN_COMPUTE(declared, Solver, ...)                                             \
  declared template Eigen::Solver& Eigen::Solver::compute(__VA_ARGS__)
#define SLAMSCOPE_EIGEN_TEMPLATES(declared)                                                        \
  SLAMSCOPE_EIGEN_COMPUTE(declared, LLT<Eigen::MatrixXd>, const Eigen::EigenBase<Eigen::MatrixXd>&); \
  SLAMSCOPE_EIGEN_COMPUTE(declared, LLT<Eigen::Matrix2d>, const Eigen::EigenBase<Eigen::Matrix2d>&); \
  SLAMSCOPE_EIGEN_COMPUTE(declared, SelfAdjointEigenSolver<Eigen::MatrixXd>,                       \
                          const Eigen::EigenBase<Eigen::MatrixXd>&, int);                          \
  declared template void Eigen::ColPivHouseholderQR<Eigen::MatrixXd>::computeInPlace()
// clang-format on

SLAMSCOPE_EIGEN_TEMPLATES(extern);
