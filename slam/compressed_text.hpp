// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace slamscope::slam {

/// How a run is written: the ending of its name says so.
enum class RunFormat { json_lines, json_lines_zst };

/// From the ending (`.jsonl`, `.jsonl.zst`). Throws std::runtime_error that lists the endings that
/// can be written; openRun reads more of them.
[[nodiscard]] RunFormat runFormat(const std::string& path);

/// Bytes of a file, unpacked where its content is zstd (whatever its name). Pipes can be read too;
/// "-" is standard input.
class TextInput {
 public:
  /// Throws std::runtime_error where the file is missing, a directory or not readable.
  explicit TextInput(const std::string& path);
  ~TextInput();
  TextInput(TextInput&&) noexcept;
  TextInput& operator=(TextInput&&) noexcept;

  /// Fills the front of `buffer`; 0 at the end. Throws on a read error or damaged zstd data.
  [[nodiscard]] std::size_t read(std::span<char> buffer);
  /// The end was reached in the middle of compressed data: the file was cut off.
  [[nodiscard]] bool cutOff() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes a file that is either whole or not there: the text goes to a temporary file beside the
/// target, which `finish` renames; destroyed without `finish`, the temporary file is removed.
/// Compresses where `zst`. "-" is standard output, and an existing pipe or device is written
/// directly (both without a temporary).
class TextOutput {
 public:
  /// Throws std::runtime_error where the folder is missing or not writable.
  TextOutput(std::string path, bool zst);
  ~TextOutput();
  TextOutput(TextOutput&&) noexcept;
  TextOutput& operator=(TextOutput&&) noexcept;

  void write(std::string_view text);
  /// Goes out at once, not buffered: somebody reads while we write.
  [[nodiscard]] bool live() const;
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace slamscope::slam
