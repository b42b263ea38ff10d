// SPDX-License-Identifier: MIT
#include "tracking/stamps.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string_view>

namespace slamscope::tracking {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string quoted(std::string_view text) {
  std::string result(1, '\'');
  result.append(text).push_back('\'');
  return result;
}

bool isDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

std::vector<FrameStamp> readStamps(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": can't be read");
  std::vector<FrameStamp> stamps;
  std::set<std::string, std::less<>> names;
  bool header = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const auto fail = [&](const std::string& what) {
      throw std::runtime_error(file.string() + ", line " + std::to_string(number) + ": " + what);
    };
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::size_t comma = text.rfind(',');
    const std::string_view name = trimmed(text.substr(0, comma));
    const std::string_view value =
        comma == std::string_view::npos ? std::string_view{} : trimmed(text.substr(comma + 1));
    if (!header) {
      if (name != "file" || value != "time_s")
        fail(quoted(text) + " where the header file,time_s was expected");
      header = true;
      continue;
    }
    long double seconds = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
    if (error != std::errc{} || end != value.data() + value.size() || !(std::abs(seconds) < 9e9L))
      fail("time_s is " + quoted(value) + ", expected a number of seconds");
    const std::chrono::nanoseconds time(std::llround(seconds * 1e9L));
    if (name.empty()) fail("no file name before the comma");
    if (!names.emplace(name).second) fail(quoted(name) + " has a stamp already");
    if (!stamps.empty() && time <= stamps.back().time)
      fail("time_s " + std::string(value) + " is not after the frame before it");
    stamps.push_back({.file = std::string(name), .time = time});
  }
  if (stamps.empty())
    throw std::runtime_error(file.string() + ": no stamp in it, expected file,time_s and lines");
  return stamps;
}

bool naturalLess(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const std::size_t first = at;
      while (at < text.size() && isDigit(text[at])) ++at;
      return std::string_view(text).substr(first, at - first);
    };
    const std::string_view x = number(a, i), y = number(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // equal but for leading zeros
}

std::chrono::nanoseconds timeAtRate(std::uint64_t k, double fps) {
  return std::chrono::nanoseconds(std::llround(static_cast<long double>(k) * 1e9L / fps));
}

}  // namespace slamscope::tracking
