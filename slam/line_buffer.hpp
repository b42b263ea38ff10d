// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace slamscope::slam {

/// Cuts a stream of bytes into lines. Memory is bounded by the longest line, which is bounded too.
class LineBuffer {
 public:
  static constexpr std::size_t kLongestLine = std::size_t{256} << 20;  ///< bytes, 256 MiB

  explicit LineBuffer(std::size_t longest = kLongestLine) : longest_(longest) {}

  /// Where the next bytes may be written, `size` of them; `commit` says how many there were.
  [[nodiscard]] std::span<char> room(std::size_t size);
  void commit(std::size_t size);
  /// The next complete line without its end ("\n" or "\r\n"), valid until the next call of `room`.
  /// Throws std::runtime_error where a line is longer than allowed; the rest of that line is then
  /// skipped.
  [[nodiscard]] std::optional<std::string_view> next();
  /// What came after the last complete line: at the end of a stream, a line without an end.
  [[nodiscard]] std::string_view rest() const;

 private:
  std::size_t longest_;
  std::string bytes_;
  std::size_t begin_ = 0;    ///< of the first line not yet handed out
  std::size_t scanned_ = 0;  ///< no line's end before here
  std::size_t end_ = 0;
  bool skipping_ = false;  ///< inside of a line that was too long
};

}  // namespace slamscope::slam
