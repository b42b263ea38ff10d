// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/formats/number_array.hpp"

struct matvar_t;

namespace slamscope::slam {

/// A variable of a .mat file, or an element of one, which keeps the whole in memory.
class MatVariable {
 public:
  enum class Kind { numbers, cells, structs, text, other };

  explicit MatVariable(std::shared_ptr<const matvar_t> variable) : variable_(std::move(variable)) {}

  [[nodiscard]] Kind kind() const;
  /// Elements of a cell or struct array; numbers of an array.
  [[nodiscard]] std::size_t count() const;
  /// Shape reversed, so that the last axis runs fastest; `reversed` is true. Throws
  /// std::runtime_error where these are no real numbers, or a sparse matrix.
  [[nodiscard]] NumberArray numbers() const;
  [[nodiscard]] std::string text() const;
  /// The elements of a cell array.
  [[nodiscard]] std::vector<MatVariable> cells() const;
  /// That field of each element of a struct array; nothing where it has none of that name.
  [[nodiscard]] std::optional<std::vector<MatVariable>> field(std::string_view name) const;

 private:
  /// An element that lives as long as the whole does; it may be missing (an empty array).
  [[nodiscard]] MatVariable part(const matvar_t* element) const {
    return MatVariable({variable_, element});
  }

  std::shared_ptr<const matvar_t> variable_;
};

/// A file of MATLAB or Octave: versions 4, 5 (-v6, -v7) and, where libmatio can, 7.3.
class MatFile {
 public:
  /// Throws std::runtime_error where the file is missing, cut off or not of that kind.
  explicit MatFile(const std::string& path);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Nothing where there is no variable of that name. Throws where it can't be read.
  [[nodiscard]] std::optional<MatVariable> read(std::string_view name) const;
  [[nodiscard]] bool has(std::string_view name) const;
  /// Whether it is there and of that kind, without reading its values.
  [[nodiscard]] bool isOf(MatVariable::Kind kind, std::string_view name) const;

 private:
  [[nodiscard]] std::optional<MatVariable> find(std::string_view name, bool with_values) const;

  std::shared_ptr<void> file_;
  std::vector<std::string> names_;
};

}  // namespace slamscope::slam
