// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace slamscope::slam {

using Shape = std::vector<std::size_t>;  ///< the last axis runs fastest (C's order)

/// "3×4×4"; "a single number" for none.
[[nodiscard]] std::string shapeName(const Shape& shape);
[[nodiscard]] std::size_t numbersIn(const Shape& shape);

/// Numbers of some shape, the last axis fastest. An array that was stored the other way round (by
/// MATLAB, or by NumPy in Fortran's order) has its shape reversed, and `reversed` is true.
struct NumberArray {
  Shape shape;
  std::vector<double> values;
  bool reversed = false;
  bool logical = false;  ///< of truth values
};

}  // namespace slamscope::slam
