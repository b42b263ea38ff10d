// SPDX-License-Identifier: MIT
#include "slam/formats/number_array.hpp"

#include <stdexcept>

namespace slamscope::slam {

std::size_t numbersIn(const Shape& shape) {
  constexpr std::size_t kMost = std::size_t{1} << 48U;  // of a damaged header
  std::size_t count = 1;
  for (const std::size_t length : shape) {
    if (length != 0 && count > kMost / length) {
      throw std::runtime_error("the array is too large: " + shapeName(shape));
    }
    count *= length;
  }
  return count;
}

std::string shapeName(const Shape& shape) {
  std::string name;
  for (const std::size_t length : shape) {
    name += (name.empty() ? "" : "×") + std::to_string(length);
  }
  return name.empty() ? "a single number" : name;
}

}  // namespace slamscope::slam
