// SPDX-License-Identifier: MIT
#include "slam/formats/bytes.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace slamscope::slam {
namespace {

constexpr std::size_t kInflateAtOnce = std::size_t{64} << 10U;

class InflatedBytes : public Bytes {
 public:
  explicit InflatedBytes(std::unique_ptr<Bytes> packed)
      : packed_(std::move(packed)), buffer_(kInflateAtOnce) {
    if (inflateInit2(&zlib_, -MAX_WBITS) != Z_OK) throw std::runtime_error("zlib has no memory");
  }
  ~InflatedBytes() override { inflateEnd(&zlib_); }
  InflatedBytes(const InflatedBytes&) = delete;
  InflatedBytes& operator=(const InflatedBytes&) = delete;

  [[nodiscard]] std::size_t read(std::span<char> out) override {
    std::size_t done = 0;
    while (done < out.size() && !ended_) {
      if (zlib_.avail_in == 0) {
        zlib_.avail_in = static_cast<uInt>(packed_->read(buffer_));
        zlib_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
      }
      const std::size_t room = std::min<std::size_t>(out.size() - done, 1U << 30U);
      zlib_.next_out = reinterpret_cast<Bytef*>(out.data() + done);
      zlib_.avail_out = static_cast<uInt>(room);
      const bool at_end = zlib_.avail_in == 0;
      const int result = inflate(&zlib_, Z_NO_FLUSH);
      done += room - zlib_.avail_out;
      ended_ = result == Z_STREAM_END || (at_end && result == Z_BUF_ERROR);
      if (!ended_ && result != Z_OK) throw std::runtime_error("its compressed data is damaged");
    }
    return done;
  }

 private:
  std::unique_ptr<Bytes> packed_;
  std::vector<char> buffer_;
  z_stream zlib_{};
  bool ended_ = false;
};

class VerifiedBytes : public Bytes {
 public:
  VerifiedBytes(std::unique_ptr<Bytes> bytes, std::uint64_t size, std::uint32_t crc)
      : bytes_(std::move(bytes)), left_(size), expected_(crc) {}

  [[nodiscard]] std::size_t read(std::span<char> out) override {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), left_));
    const std::size_t got = bytes_->read(out.first(wanted));
    if (got != wanted) throw std::runtime_error("it is cut off");
    for (std::size_t done = 0; done < got;) {
      const std::size_t part = std::min<std::size_t>(got - done, 1U << 30U);
      crc_ =
          crc32(crc_, reinterpret_cast<const Bytef*>(out.data() + done), static_cast<uInt>(part));
      done += part;
    }
    left_ -= got;
    if (left_ == 0 && crc_ != expected_) throw std::runtime_error("its data is damaged (CRC)");
    return got;
  }

 private:
  std::unique_ptr<Bytes> bytes_;
  std::uint64_t left_;
  std::uint32_t expected_;
  uLong crc_ = crc32(0, nullptr, 0);
};

}  // namespace

FileBytes::FileBytes(const std::string& path, std::uint64_t offset, std::uint64_t size)
    : file_(path, std::ios::binary), left_(size) {
  if (!file_) throw std::runtime_error(path + ": can't be opened (" + std::strerror(errno) + ")");
  file_.seekg(static_cast<std::streamoff>(offset));
}

std::size_t FileBytes::read(std::span<char> buffer) {
  const auto wanted = std::min<std::uint64_t>(buffer.size(), left_);
  file_.read(buffer.data(), static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(file_.gcount());
  left_ -= got;
  return got;
}

std::unique_ptr<Bytes> inflated(std::unique_ptr<Bytes> packed) {
  return std::make_unique<InflatedBytes>(std::move(packed));
}

std::unique_ptr<Bytes> verified(std::unique_ptr<Bytes> bytes, std::uint64_t size,
                                std::uint32_t crc) {
  return std::make_unique<VerifiedBytes>(std::move(bytes), size, crc);
}

}  // namespace slamscope::slam
