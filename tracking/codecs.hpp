// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace slamscope::tracking {

/// Rows of pixels without gaps, each blue, green, red.
struct BgrPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bgr;
};

/// A video being read.
class VideoReader {
 public:
  VideoReader() = default;
  VideoReader(const VideoReader&) = delete;
  VideoReader& operator=(const VideoReader&) = delete;
  virtual ~VideoReader() = default;
  /// The next frame; nothing at the end.
  virtual std::optional<BgrPicture> next() = 0;
  /// By the stream's own clock, of the frame read last.
  [[nodiscard]] virtual double positionMs() const = 0;
  /// Not positive where the file doesn't say.
  [[nodiscard]] virtual double framesPerSecond() const = 0;
  /// A guess from the duration in some formats; not positive where the file doesn't say.
  [[nodiscard]] virtual double count() const = 0;
};

/// A video being written; closed by the destructor.
class VideoWriter {
 public:
  VideoWriter() = default;
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;
  virtual ~VideoWriter() = default;
  virtual void write(const BgrPicture& picture) = 0;
};

/// Pictures and videos in files.
class Codecs {
 public:
  Codecs() = default;
  Codecs(const Codecs&) = delete;
  Codecs& operator=(const Codecs&) = delete;
  virtual ~Codecs() = default;
  /// Nothing where the file or the bytes are no picture.
  [[nodiscard]] virtual std::optional<BgrPicture> read(const std::filesystem::path& file) const = 0;
  [[nodiscard]] virtual std::optional<BgrPicture> decode(
      std::span<const std::uint8_t> bytes) const = 0;
  /// PNG at the lowest compression (a frame's time matters more than a third of its bytes), or JPEG
  /// at quality 88, by the file's ending. False where it can't be written.
  [[nodiscard]] virtual bool write(const std::filesystem::path& file,
                                   const BgrPicture& picture) const = 0;
  /// Null where FFmpeg can't read the file.
  [[nodiscard]] virtual std::unique_ptr<VideoReader> openVideo(
      const std::filesystem::path& file) const = 0;
  /// H.264, or MPEG-4 part 2 where this FFmpeg has no encoder for it. Null where it can't be
  /// written.
  [[nodiscard]] virtual std::unique_ptr<VideoWriter> createVideo(const std::filesystem::path& file,
                                                                 double frames_per_second,
                                                                 int width, int height) const = 0;
};

/// OpenCV's imgcodecs and videoio. They bring 184 more shared libraries with them, 0.17 s of a
/// program's start, so they are in a library of their own (libslamscope_codecs.so, beside the
/// program), which the first call opens. Throws std::runtime_error where it isn't there.
[[nodiscard]] const Codecs& codecs();

}  // namespace slamscope::tracking
