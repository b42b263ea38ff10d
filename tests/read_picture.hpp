// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "tracking/codecs.hpp"

namespace slamscope::test {

/// BGR. Throws std::runtime_error where the file is no picture.
inline cv::Mat readPicture(const std::filesystem::path& file) {
  auto picture = tracking::codecs().read(file);
  if (!picture) throw std::runtime_error(file.string() + ": no picture");
  return cv::Mat(picture->height, picture->width, CV_8UC3, picture->bgr.data()).clone();
}

}  // namespace slamscope::test
