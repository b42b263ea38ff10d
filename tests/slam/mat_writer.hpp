// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <matio.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace slamscope::slam {

/// Variables as MATLAB would save them. Each is owned by the one that it is put into, at last by
/// saveMat.
inline matvar_t* matMatrix(Eigen::MatrixXd values, const char* name = nullptr) {
  std::size_t shape[2] = {static_cast<std::size_t>(values.rows()),
                          static_cast<std::size_t>(values.cols())};
  return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, shape, values.data(), 0);
}

/// N × M × matrices.size(), or the columns beside each other where these are vectors.
inline matvar_t* matStack(const std::vector<Eigen::MatrixXd>& steps, const char* name) {
  std::vector<double> values;
  for (const Eigen::MatrixXd& step : steps) {
    values.insert(values.end(), step.data(), step.data() + step.size());
  }
  const bool vectors = steps.front().cols() == 1;
  std::size_t shape[3] = {static_cast<std::size_t>(steps.front().rows()),
                          static_cast<std::size_t>(vectors ? steps.size() : steps.front().cols()),
                          steps.size()};
  return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, vectors ? 2 : 3, shape, values.data(), 0);
}

inline matvar_t* matText(std::string text, const char* name = nullptr) {
  std::size_t shape[2] = {1, text.size()};
  return Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF8, 2, shape, text.data(), 0);
}

inline matvar_t* matCells(std::vector<matvar_t*> cells, const char* name) {
  std::size_t shape[2] = {1, cells.size()};
  return Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, shape, cells.data(), 0);
}

inline matvar_t* matCells(const std::vector<Eigen::MatrixXd>& steps, const char* name) {
  std::vector<matvar_t*> cells;
  for (const Eigen::MatrixXd& step : steps) cells.push_back(matMatrix(step));
  return matCells(std::move(cells), name);
}

/// `values`: all fields of the first element, then of the second, …
inline matvar_t* matStructs(std::vector<const char*> fields, std::vector<matvar_t*> values,
                            const char* name = nullptr) {
  std::size_t shape[2] = {1, values.size() / fields.size()};
  matvar_t* result =
      Mat_VarCreateStruct(name, 2, shape, fields.data(), static_cast<unsigned>(fields.size()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    Mat_VarSetStructFieldByName(result, fields[k % fields.size()], k / fields.size(), values[k]);
  }
  return result;
}

inline void saveMat(const std::string& path, const std::vector<matvar_t*>& variables,
                    mat_ft version = MAT_FT_MAT5, matio_compression packed = MAT_COMPRESSION_ZLIB) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  ASSERT_NE(file, nullptr);
  for (matvar_t* variable : variables) {
    EXPECT_EQ(Mat_VarWrite(file, variable, packed), 0);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

}  // namespace slamscope::slam
