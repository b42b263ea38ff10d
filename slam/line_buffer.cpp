// SPDX-License-Identifier: MIT
#include "slam/line_buffer.hpp"

#include <cstring>
#include <stdexcept>

namespace slamscope::slam {

std::span<char> LineBuffer::room(std::size_t size) {
  if (begin_ != 0) {
    std::memmove(bytes_.data(), bytes_.data() + begin_, end_ - begin_);
    scanned_ -= begin_;
    end_ -= begin_;
    begin_ = 0;
  }
  if (bytes_.size() < end_ + size) bytes_.resize(2 * end_ + size);
  return {bytes_.data() + end_, size};
}

void LineBuffer::commit(std::size_t size) {
  end_ += size;
}

std::optional<std::string_view> LineBuffer::next() {
  while (true) {
    const char* data = bytes_.data();
    const void* found = std::memchr(data + scanned_, '\n', end_ - scanned_);
    if (found == nullptr) break;
    const auto stop = static_cast<std::size_t>(static_cast<const char*>(found) - data);
    std::string_view line(data + begin_, stop - begin_);
    begin_ = scanned_ = stop + 1;
    if (skipping_) {
      skipping_ = false;
      continue;
    }
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  scanned_ = end_;
  if (skipping_) {
    begin_ = end_;
  } else if (end_ - begin_ > longest_) {
    begin_ = end_;
    skipping_ = true;
    throw std::runtime_error("line: expected at most " + std::to_string(longest_ >> 20U) +
                             " MiB, found no end of line");
  }
  return std::nullopt;
}

std::string_view LineBuffer::rest() const {
  if (skipping_) return {};
  return std::string_view(bytes_).substr(begin_, end_ - begin_);
}

}  // namespace slamscope::slam
