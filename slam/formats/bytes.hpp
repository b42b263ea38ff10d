// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <span>
#include <string>

namespace slamscope::slam {

/// Bytes, one after the other.
class Bytes {
 public:
  Bytes() = default;
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;
  virtual ~Bytes() = default;
  /// Fills `buffer`; fewer bytes than that at the end only. Throws std::runtime_error for what
  /// can't be read.
  [[nodiscard]] virtual std::size_t read(std::span<char> buffer) = 0;
};

/// `size` bytes of a file from `offset` on, or all from there.
class FileBytes : public Bytes {
 public:
  static constexpr std::uint64_t kToTheEnd = ~std::uint64_t{0};
  /// Throws std::runtime_error where the file is missing or not readable.
  explicit FileBytes(const std::string& path, std::uint64_t offset = 0,
                     std::uint64_t size = kToTheEnd);
  [[nodiscard]] std::size_t read(std::span<char> buffer) override;

 private:
  std::ifstream file_;
  std::uint64_t left_;
};

/// Unpacks raw deflate data (RFC 1951), as zip archives hold it. Damaged data throws.
[[nodiscard]] std::unique_ptr<Bytes> inflated(std::unique_ptr<Bytes> packed);

/// The same bytes, which must be `size` many and have this CRC-32: throws where they end early, and
/// with the last one where they do not fit.
[[nodiscard]] std::unique_ptr<Bytes> verified(std::unique_ptr<Bytes> bytes, std::uint64_t size,
                                              std::uint32_t crc);

}  // namespace slamscope::slam
