// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "slam/formats/bytes.hpp"
#include "slam/formats/number_array.hpp"

namespace slamscope::slam {

/// Reads one array in NumPy's format (NEP 1: versions 1 to 3), number by number.
///
/// Throws std::runtime_error without name or file for what can't be read; an array of pickled
/// objects is refused with the way out.
class NpyStream {
 public:
  /// Reads the header.
  explicit NpyStream(std::unique_ptr<Bytes> bytes);

  /// As NumPy names it: reversed where the array is in Fortran's order, see NumberArray.
  [[nodiscard]] const Shape& shape() const { return shape_; }
  [[nodiscard]] bool reversed() const { return reversed_; }
  [[nodiscard]] bool isText() const { return kind_ == 'U' || kind_ == 'S'; }

  /// The next numbers, converted; all that were asked for, or it throws: cut off.
  void read(std::span<double> numbers);
  /// All of it, from the beginning.
  [[nodiscard]] NumberArray readAll();
  /// All of an array of words, without the zeros that fill them up.
  [[nodiscard]] std::vector<std::string> readWords();

 private:
  void parse(const std::string& header);
  void fill(std::span<char> buffer);

  std::unique_ptr<Bytes> bytes_;
  Shape shape_;
  bool reversed_ = false;
  char kind_ = 0;         ///< f, i, u, b, U, S
  std::size_t item_ = 0;  ///< bytes of an item
  bool big_endian_ = false;
  std::vector<char> raw_;
};

}  // namespace slamscope::slam
