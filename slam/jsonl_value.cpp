// SPDX-License-Identifier: MIT
#include "slam/jsonl_value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace slamscope::slam::json {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What languages write where JSON has no word for it, and numbers beyond the range of double.
std::optional<double> unusualNumber(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
    if (!text.empty() && (text.back() < 'A' || text.back() > 'z')) return std::nullopt;
  }
  if (text == "null") return kNaN;
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  if (text == "NaN" || text == "nan" || text == "NAN") return kNaN;
  if (text == "Infinity" || text == "inf" || text == "Inf" || text == "INF") {
    return negative ? -kInfinity : kInfinity;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error != std::errc::result_out_of_range) {
    return std::nullopt;
  }
  const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
  return (negative ? -1.0 : 1.0) * (tiny ? 0.0 : kInfinity);
}

double number(simdjson::simdjson_result<Value> element, std::string_view field) {
  double result = 0.0;
  if (element.get_double().get(result) == simdjson::SUCCESS) return result;
  Value value;
  check(element.get(value), field);
  return json::number(value, field);
}

}  // namespace

bool Numbers::rowsOf(std::size_t length) const {
  return !rows.empty() &&
         std::all_of(rows.begin(), rows.end(), [&](std::size_t row) { return row == length; });
}

bool Numbers::isList() const {
  return rows.size() <= 1 || rowsOf(1);
}

std::string Numbers::describe() const {
  if (rows.empty()) return std::to_string(values.size()) + " numbers";
  const std::string count =
      std::to_string(rows.size()) + (rows.size() == 1 ? " row of " : " rows of ");
  if (rowsOf(rows.front())) return count + std::to_string(rows.front()) + " numbers";
  return count + "different lengths, " + std::to_string(values.size()) + " numbers";
}

void fail(std::string_view field, std::string_view expected, std::string_view found) {
  constexpr std::size_t kLongest = 40;
  std::string text(field);
  text.append(": expected ").append(expected).append(", found ").append(found.substr(0, kLongest));
  if (found.size() > kLongest) text += "…";
  throw std::runtime_error(text);
}

void check(simdjson::error_code error, std::string_view field) {
  if (error == simdjson::SUCCESS) return;
  fail(field, "valid JSON", simdjson::error_message(error));
}

std::string_view token(Value& value) {
  std::string_view text = value.raw_json_token();
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

double number(Value& value, std::string_view field) {
  double result = 0.0;
  if (value.get_double().get(result) == simdjson::SUCCESS) return result;
  const auto unusual = unusualNumber(token(value));
  if (!unusual) fail(field, "a number", token(value));
  return *unusual;
}

std::uint64_t count(Value& value, std::string_view field) {
  std::uint64_t result = 0;
  if (value.get_uint64().get(result) == simdjson::SUCCESS) return result;
  double real = 0.0;  // 4.0, as some languages write every number
  if (value.get_double().get(real) == simdjson::SUCCESS && real >= 0.0 && real <= 0x1p53 &&
      real == std::floor(real)) {
    return static_cast<std::uint64_t>(real);
  }
  fail(field, "a whole number, not negative", token(value));
}

std::int64_t integer(Value& value, std::string_view field) {
  std::int64_t result = 0;
  if (value.get_int64().get(result) == simdjson::SUCCESS) return result;
  double real = 0.0;
  if (value.get_double().get(real) == simdjson::SUCCESS && std::abs(real) < 0x1p63 &&
      real == std::floor(real)) {
    return static_cast<std::int64_t>(real);
  }
  std::string_view digits = token(value);
  if (digits.size() > 2 && digits.front() == '"' && digits.back() == '"') {
    digits = digits.substr(1, digits.size() - 2);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), result);
    if (error == std::errc() && end == digits.data() + digits.size()) return result;
  }
  fail(field, "a whole number, or one as text", token(value));
}

std::string text(Value& value, std::string_view field) {
  std::string_view result;
  if (value.get_string().get(result) != simdjson::SUCCESS) fail(field, "text", token(value));
  return std::string(result);
}

void numbers(Value& value, std::string_view field, Numbers& result) {
  result.values.clear();
  result.rows.clear();
  if (!isList(value)) {
    result.values.push_back(number(value, field));
    return;
  }
  simdjson::ondemand::array list;
  check(value.get_array().get(list), field);
  for (auto element : list) {
    Value item;
    check(element.get(item), field);
    const bool nested = isList(item);
    const std::size_t before = result.values.size();
    if (before != 0 && nested == result.rows.empty()) {
      fail(field, "either numbers or rows of numbers", "both");
    }
    if (!nested) {
      result.values.push_back(number(item, field));
      continue;
    }
    simdjson::ondemand::array row;
    check(item.get_array().get(row), field);
    for (auto inner : row) result.values.push_back(number(inner, field));
    result.rows.push_back(result.values.size() - before);
  }
}

std::vector<std::uint64_t> ids(Value& value, std::string_view field) {
  std::vector<std::uint64_t> result;
  if (isNull(value)) return result;
  forEach(value, field, [&](Value& item) {
    forEach(item, field, [&](Value& inner) { result.push_back(count(inner, field)); });
  });
  return result;
}

std::vector<std::string> texts(Value& value, std::string_view field) {
  std::vector<std::string> result;
  if (isNull(value)) return result;
  forEach(value, field, [&](Value& item) { result.push_back(text(item, field)); });
  return result;
}

Eigen::MatrixXd symmetric(Value& value, std::string_view field, int size) {
  Numbers read;
  numbers(value, field, read);
  const auto n = static_cast<std::size_t>(size);
  const bool square = read.rows.empty() || (read.rows.size() == n && read.rowsOf(n));
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  std::size_t next = 0;
  if (read.values.size() == n * n && square) {
    for (int row = 0; row < size; ++row) {
      for (int col = 0; col < size; ++col) result(row, col) = read.values[next++];
    }
  } else if (read.values.size() == n * (n + 1) / 2 && read.rows.empty()) {
    for (int row = 0; row < size; ++row) {
      for (int col = 0; col <= row; ++col)
        result(row, col) = result(col, row) = read.values[next++];
    }
  } else if (read.values.size() == n && read.isList()) {
    for (int row = 0; row < size; ++row) result(row, row) = read.values[next++];
  } else {
    const std::string side = std::to_string(size);
    fail(field, side + "×" + side + " numbers", read.describe());
  }
  return result;
}

Eigen::VectorXd vector(Value& value, std::string_view field, int size) {
  Numbers read;
  numbers(value, field, read);
  if (!read.isList() || static_cast<int>(read.values.size()) != size) {
    fail(field, std::to_string(size) + " numbers", read.describe());
  }
  return Eigen::Map<const Eigen::VectorXd>(read.values.data(), size);
}

}  // namespace slamscope::slam::json
