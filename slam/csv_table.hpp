// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Rows of a text file, with cells between commas or blanks; blank lines and lines that begin with
/// `#` or `%` are passed over. Every failure is a std::runtime_error "file:line: column: expected
/// …, found …".
class TextTable {
 public:
  enum class Separator { comma, blank };

  /// Throws where the file is missing or not readable.
  TextTable(std::string path, Separator separator);

  /// Goes to the next row; false at the end.
  bool next();

  [[nodiscard]] std::size_t cells() const { return cells_.size(); }
  [[nodiscard]] std::string_view text(std::size_t cell) const { return cells_.at(cell); }
  [[nodiscard]] double number(std::size_t cell, std::string_view column) const;  ///< finite
  /// As `number`; NaN where the cell is empty or says nan or inf.
  [[nodiscard]] double numberIfAny(std::size_t cell, std::string_view column) const;
  [[nodiscard]] FeatureId id(std::size_t cell, std::string_view column) const;
  /// Seconds, not before the time of the row before.
  [[nodiscard]] std::chrono::nanoseconds time(std::size_t cell, std::string_view column);
  void expectCells(std::size_t count, std::string_view names) const;

  [[noreturn]] void fail(std::string_view column, std::string_view expected,
                         std::string_view found) const;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  void split(std::string_view row);

  std::string path_;
  Separator separator_;
  std::string content_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
  std::vector<std::string_view> cells_;
  std::optional<std::chrono::nanoseconds> last_time_;
  std::string_view last_time_text_;
};

}  // namespace slamscope::slam
