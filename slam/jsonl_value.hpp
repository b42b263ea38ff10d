// SPDX-License-Identifier: MIT
#pragma once

#include <simdjson.h>

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace slamscope::slam::json {

// Inside of the JSON line reader only: lenient reading of single values. `field` names the value
// in messages; every function throws std::runtime_error "field: expected …, found …".

using Value = simdjson::ondemand::value;

/// Numbers as they stood: a flat list (`rows` empty), or a list of lists (lengths of the rows).
struct Numbers {
  std::vector<double> values;
  std::vector<std::size_t> rows;

  /// Nested, each inner list this long.
  [[nodiscard]] bool rowsOf(std::size_t length) const;
  /// A flat list, or what other languages make of one: a single row, or a column of rows of one.
  [[nodiscard]] bool isList() const;
  [[nodiscard]] std::string describe() const;  ///< "3 rows of 4 numbers", "7 numbers"
};

[[noreturn]] void fail(std::string_view field, std::string_view expected, std::string_view found);
void check(simdjson::error_code error, std::string_view field);

/// The text of the value, up to its end, for messages and tokens JSON doesn't know (NaN).
[[nodiscard]] std::string_view token(Value& value);
[[nodiscard]] inline bool isNull(Value& value) {
  return token(value) == "null";
}
[[nodiscard]] inline bool isList(Value& value) {
  return token(value).starts_with('[');
}

[[nodiscard]] double number(Value& value, std::string_view field);
[[nodiscard]] std::uint64_t count(Value& value, std::string_view field);
[[nodiscard]] std::int64_t integer(Value& value, std::string_view field);
[[nodiscard]] std::string text(Value& value, std::string_view field);

/// A number, a list of numbers or a list of lists of numbers; `numbers` is cleared first.
void numbers(Value& value, std::string_view field, Numbers& numbers);
[[nodiscard]] std::vector<std::uint64_t> ids(Value& value, std::string_view field);
[[nodiscard]] std::vector<std::string> texts(Value& value, std::string_view field);
/// n×n symmetric, n = 2 or 3: full, packed lower triangle or (a list of n) its diagonal.
[[nodiscard]] Eigen::MatrixXd symmetric(Value& value, std::string_view field, int size);
[[nodiscard]] Eigen::VectorXd vector(Value& value, std::string_view field, int size);

/// Calls `use(element)` for each element of a list, or once for a value that is no list.
template <class Use>
void forEach(Value& value, std::string_view field, Use use) {
  if (!isList(value)) return use(value);
  simdjson::ondemand::array list;
  check(value.get_array().get(list), field);
  for (auto element : list) {
    Value item;
    check(element.get(item), field);
    use(item);
  }
}

/// Calls `use(key, value)` for each field of an object.
template <class Object, class Use>
void forEachField(Object&& source, std::string_view field, Use use) {
  simdjson::ondemand::object object;
  if (source.get_object().get(object) != simdjson::SUCCESS) {
    fail(field, "an object {…}", "something else");
  }
  for (auto pair : object) {
    std::string_view key;
    Value value;
    check(pair.unescaped_key().get(key), field);
    check(pair.value().get(value), field);
    use(key, value);
  }
}

}  // namespace slamscope::slam::json
