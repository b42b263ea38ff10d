// SPDX-License-Identifier: MIT
#include "tracking/frame_source.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "tracking/image_source.hpp"
#include "tracking/video_source.hpp"

namespace slamscope::tracking {
namespace {

namespace fs = std::filesystem;

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::unique_ptr<FrameSource> openFrameSource(const std::string& spec,
                                             const FrameSourceOptions& options) {
  if (spec.find('%') != std::string::npos && !fs::exists(spec))
    return openImagePattern(spec, options.fps);
  if (isNumber(spec) && !fs::exists(spec)) return openV4l2("/dev/video" + spec, options.v4l2);
  if (spec.starts_with("/dev/")) return openV4l2(spec, options.v4l2);
  if (!fs::exists(spec)) throw std::runtime_error(spec + ": no such file, directory or camera");
  if (fs::is_directory(spec)) return openImageDirectory(spec, options.fps);
  if (fs::is_character_file(spec)) return openV4l2(spec, options.v4l2);
  if (isImageFile(spec)) return openImage(spec);
  return openVideo(spec, options.fps);
}

}  // namespace slamscope::tracking
