// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace slamscope::tracking {

class FrameSource;

/// Has the ending of a picture that can be read (.png .jpg .jpeg .bmp .tif .tiff .pgm .ppm .webp).
[[nodiscard]] bool isImageFile(const std::filesystem::path& file);

/// A directory's pictures in natural order. With a stamps.csv in it: those that it names, in its
/// order. `fps` as in FrameSourceOptions. Throws std::runtime_error: no picture, a named one that
/// is not there.
[[nodiscard]] std::unique_ptr<FrameSource> openImageDirectory(
    const std::filesystem::path& directory, double fps);
/// The pictures whose names fit `dir/name-%05d.png` (one %d or %0Nd, in the name only), by number;
/// a stamps.csv beside them counts as above. Throws std::runtime_error: no such field, no picture.
[[nodiscard]] std::unique_ptr<FrameSource> openImagePattern(const std::string& pattern, double fps);
/// One picture: a source of one frame, at time 0.
[[nodiscard]] std::unique_ptr<FrameSource> openImage(const std::filesystem::path& file);

}  // namespace slamscope::tracking
