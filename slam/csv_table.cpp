// SPDX-License-Identifier: MIT
#include "slam/csv_table.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/compressed_text.hpp"
#include "slam/decimal_time.hpp"

namespace slamscope::slam {
namespace {

std::string readAll(const std::string& path) {
  TextInput input(path);
  std::string content;
  std::size_t size = 0;
  do {
    const std::size_t before = content.size();
    content.resize(before + (std::size_t{1} << 20U));
    size = input.read({content.data() + before, content.size() - before});
    content.resize(before + size);
  } while (size != 0);
  if (content.starts_with("\xef\xbb\xbf")) content.erase(0, 3);
  return content;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\"";
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

}  // namespace

TextTable::TextTable(std::string path, Separator separator)
    : path_(std::move(path)), separator_(separator), content_(readAll(path_)) {}

bool TextTable::next() {
  while (position_ < content_.size()) {
    const std::size_t stop = std::min(content_.find('\n', position_), content_.size());
    const auto row = std::string_view(content_).substr(position_, stop - position_);
    position_ = stop + 1;
    ++line_;
    const std::string_view words = trimmed(row);
    if (words.empty() || words.front() == '#' || words.front() == '%') continue;
    split(row);
    return true;
  }
  return false;
}

void TextTable::split(std::string_view row) {
  cells_.clear();
  if (separator_ == Separator::comma) {
    for (std::size_t comma = 0; comma != row.npos; row.remove_prefix(comma + 1)) {
      comma = row.find(',');
      cells_.push_back(trimmed(row.substr(0, comma)));
      if (comma == row.npos) return;
    }
  }
  constexpr std::string_view kBlank = " \t\r";
  for (auto begin = row.find_first_not_of(kBlank); begin != row.npos;
       begin = row.find_first_not_of(kBlank)) {
    row.remove_prefix(begin);
    const std::size_t end = std::min(row.find_first_of(kBlank), row.size());
    cells_.push_back(row.substr(0, end));
    row.remove_prefix(end);
  }
}

double TextTable::number(std::size_t cell, std::string_view column) const {
  std::string_view digits = text(cell);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) {
    fail(column, "a number", text(cell));
  }
  return value;
}

double TextTable::numberIfAny(std::size_t cell, std::string_view column) const {
  std::string_view digits = text(cell);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = std::numeric_limits<double>::quiet_NaN();
  if (digits.empty()) return value;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    fail(column, "a number, or nan for none", text(cell));
  }
  return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
}

FeatureId TextTable::id(std::size_t cell, std::string_view column) const {
  const std::string_view digits = text(cell);
  FeatureId value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    fail(column, "a whole number, not negative", digits);
  }
  return value;
}

std::chrono::nanoseconds TextTable::time(std::size_t cell, std::string_view column) {
  const auto time = parseSeconds(text(cell));
  if (!time) fail(column, "a number of seconds", text(cell));
  if (last_time_ && *time < *last_time_) {
    fail(column, "at least " + std::string(last_time_text_) + " as in the row before", text(cell));
  }
  last_time_ = time;
  last_time_text_ = text(cell);
  return *time;
}

void TextTable::expectCells(std::size_t count, std::string_view names) const {
  if (cells() == count) return;
  fail(names, std::to_string(count) + " values", std::to_string(cells()));
}

void TextTable::fail(std::string_view column, std::string_view expected,
                     std::string_view found) const {
  std::string message = path_ + ":" + std::to_string(line_) + ": ";
  message.append(column).append(": expected ").append(expected).append(", found ");
  throw std::runtime_error(message.append(found.empty() ? "nothing" : found));
}

}  // namespace slamscope::slam
