// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "slam/formats/bytes.hpp"

namespace slamscope::slam {

/// Reads zip archives (PKWARE's APPNOTE 6.3.3), as far as NumPy writes them: members stored or
/// deflated, sizes of 64 bits, one disk.
class ZipArchive {
 public:
  struct Member {
    std::uint64_t header = 0;  ///< offset of its local header
    std::uint64_t packed = 0;  ///< bytes in the file
    std::uint64_t size = 0;    ///< bytes unpacked
    std::uint32_t crc = 0;
    std::uint16_t method = 0;
  };

  /// Reads the directory at the end of the file. Throws std::runtime_error "path: …" where the file
  /// is missing, cut off, or no zip archive.
  explicit ZipArchive(std::string path);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const std::map<std::string, Member>& members() const { return members_; }
  /// The unpacked bytes of a member that is there; verified, see `verified`.
  [[nodiscard]] std::unique_ptr<Bytes> open(const std::string& name) const;

 private:
  std::string path_;
  std::map<std::string, Member> members_;
};

}  // namespace slamscope::slam
