// SPDX-License-Identifier: MIT
#include "slam/formats/zip_archive.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace slamscope::slam {
namespace {

// Records of a zip archive (APPNOTE 4.3.7, 4.3.12, 4.3.14, 4.3.15, 4.3.16), without their ends of
// varying length; numbers are little endian.
constexpr std::size_t kLocal = 30, kCentral = 46, kEnd64 = 56, kLocator64 = 20, kEnd = 22;
constexpr std::uint16_t kStored = 0, kDeflated = 8, kExtra64 = 1, kEncrypted = 1;
constexpr std::uint32_t kIn64 = 0xffffffff;

std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t size) {
  if (at + size > bytes.size()) throw std::runtime_error("its zip directory is damaged");
  std::uint64_t value = 0;
  for (std::size_t k = size; k-- > 0;) {
    value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
  }
  return value;
}

std::string part(const std::string& path, std::uint64_t offset, std::uint64_t size) {
  std::string bytes(size, '\0');
  bytes.resize(FileBytes(path, offset, size).read(bytes));
  return bytes;
}

struct Directory {
  std::uint64_t offset, size, members;
};

/// From the record at the end of the file, which a comment of up to 64 KiB may follow.
Directory findDirectory(const std::string& path, std::uint64_t file_size) {
  const std::uint64_t tail_size = std::min<std::uint64_t>(file_size, kEnd + 0xffff);
  const std::string tail = part(path, file_size - tail_size, tail_size);
  const std::size_t end = tail.rfind("PK\x05\x06");
  if (end == tail.npos || end + kEnd > tail.size()) {
    const bool zip = part(path, 0, 4) == "PK\x03\x04";
    throw std::runtime_error(zip ? "it is cut off: the zip directory at its end is missing"
                                 : "expected a zip archive as np.savez writes it");
  }
  Directory result{number(tail, end + 16, 4), number(tail, end + 12, 4), number(tail, end + 10, 2)};
  if (end >= kLocator64 && tail.compare(end - kLocator64, 4, "PK\x06\x07") == 0) {
    const std::string end64 = part(path, number(tail, end - kLocator64 + 8, 8), kEnd64);
    result = {number(end64, 48, 8), number(end64, 40, 8), number(end64, 32, 8)};
  }
  if (result.offset > file_size || result.size > file_size - result.offset) {
    throw std::runtime_error("its zip directory is damaged");
  }
  return result;
}

/// Sizes that do not fit in 32 bits stand in a field of their own (APPNOTE 4.5.3).
void readExtra(std::string_view extra, ZipArchive::Member& member) {
  while (extra.size() >= 4) {
    const std::size_t size = number(extra, 2, 2);
    if (number(extra, 0, 2) == kExtra64) {
      std::size_t at = 4;
      for (std::uint64_t* value : {&member.size, &member.packed, &member.header}) {
        if (*value != kIn64) continue;
        *value = number(extra, at, 8);
        at += 8;
      }
    }
    extra.remove_prefix(std::min(extra.size(), 4 + size));
  }
}

std::map<std::string, ZipArchive::Member> readMembers(const std::string& path) {
  const std::uint64_t file_size = std::filesystem::file_size(path);
  const Directory directory = findDirectory(path, file_size);
  const std::string bytes = part(path, directory.offset, directory.size);
  std::map<std::string, ZipArchive::Member> members;
  std::size_t at = 0;
  for (std::uint64_t k = 0; k < directory.members; ++k) {
    ZipArchive::Member member;
    if ((number(bytes, at + 8, 2) & kEncrypted) != 0) throw std::runtime_error("it is encrypted");
    member.method = static_cast<std::uint16_t>(number(bytes, at + 10, 2));
    member.crc = static_cast<std::uint32_t>(number(bytes, at + 16, 4));
    member.packed = number(bytes, at + 20, 4);
    member.size = number(bytes, at + 24, 4);
    member.header = number(bytes, at + 42, 4);
    const std::size_t name = number(bytes, at + 28, 2), extra = number(bytes, at + 30, 2);
    const std::size_t comment = number(bytes, at + 32, 2);
    if (at + kCentral + name + extra > bytes.size()) {
      throw std::runtime_error("its zip directory is damaged");
    }
    readExtra(std::string_view(bytes).substr(at + kCentral + name, extra), member);
    members.emplace(bytes.substr(at + kCentral, name), member);
    at += kCentral + name + extra + comment;
  }
  return members;
}

}  // namespace

ZipArchive::ZipArchive(std::string path) : path_(std::move(path)) {
  const FileBytes there(path_);
  try {
    members_ = readMembers(path_);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path_ + ": " + error.what());
  }
}

std::unique_ptr<Bytes> ZipArchive::open(const std::string& name) const {
  const Member& member = members_.at(name);
  if (member.method != kStored && member.method != kDeflated) {
    throw std::runtime_error("expected a member stored or deflated, found zip method " +
                             std::to_string(member.method));
  }
  const std::string local = part(path_, member.header, kLocal);
  const std::uint64_t data = member.header + kLocal + number(local, 26, 2) + number(local, 28, 2);
  std::unique_ptr<Bytes> bytes = std::make_unique<FileBytes>(path_, data, member.packed);
  if (member.method == kDeflated) bytes = inflated(std::move(bytes));
  return verified(std::move(bytes), member.size, member.crc);
}

}  // namespace slamscope::slam
