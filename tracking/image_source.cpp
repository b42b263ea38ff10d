// SPDX-License-Identifier: MIT
#include "tracking/image_source.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <optional>
#include <stdexcept>

#include "tracking/codecs.hpp"
#include "tracking/frame_source.hpp"
#include "tracking/numbered_name.hpp"
#include "tracking/stamps.hpp"

namespace slamscope::tracking {
namespace {

namespace fs = std::filesystem;

struct Picture {
  fs::path file;
  std::chrono::nanoseconds time;
};

class ImageSource final : public FrameSource {
 public:
  ImageSource(std::vector<Picture> pictures, bool stamped)
      : pictures_(std::move(pictures)), stamped_(stamped) {}

  std::optional<Frame> next() override {
    if (next_ == pictures_.size()) return std::nullopt;
    const auto& [file, time] = pictures_[next_];
    const std::string name = file.string();
    std::optional<BgrPicture> picture = codecs().read(file);
    if (!picture) throw std::runtime_error(name + ": can't be read as a picture");
    if (next_ > 0 && (picture->width != width_ || picture->height != height_))
      throw std::runtime_error(name + ": is " + std::to_string(picture->width) + " x " +
                               std::to_string(picture->height) + " px, the frames before it " +
                               std::to_string(width_) + " x " + std::to_string(height_));
    width_ = picture->width;
    height_ = picture->height;
    return Frame{.time = time,
                 .sequence = next_++,
                 .source = name,
                 .width = width_,
                 .height = height_,
                 .bgr = std::move(picture->bgr)};
  }
  bool stamped() const override { return stamped_; }
  std::optional<std::uint64_t> count() const override { return pictures_.size(); }

 private:
  std::vector<Picture> pictures_;
  bool stamped_;
  std::size_t next_ = 0;
  int width_ = 0, height_ = 0;
};

/// The pictures of a directory that `wanted` accepts, with their times.
std::unique_ptr<FrameSource> open(const fs::path& directory, double fps, const std::string& spec,
                                  const std::function<bool(const std::string&)>& wanted) {
  std::vector<Picture> pictures;
  const fs::path csv = directory / "stamps.csv";
  const bool stamped = fps <= 0 && fs::exists(csv);
  if (stamped) {
    for (const FrameStamp& stamp : readStamps(csv)) {
      if (!wanted(stamp.file)) continue;
      if (!fs::exists(directory / stamp.file))
        throw std::runtime_error(csv.string() + " names " + stamp.file + ", which is not there");
      pictures.push_back({directory / stamp.file, stamp.time});
    }
  } else {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && isImageFile(entry.path()) && wanted(name))
        names.push_back(name);
    }
    std::sort(names.begin(), names.end(), naturalLess);
    for (const std::string& name : names)
      pictures.push_back({directory / name, timeAtRate(pictures.size(), fps > 0 ? fps : 30)});
  }
  if (pictures.empty()) throw std::runtime_error(spec + ": no picture there");
  return std::make_unique<ImageSource>(std::move(pictures), stamped);
}

}  // namespace

bool isImageFile(const fs::path& file) {
  static const std::array<std::string, 9> kEndings = {".png",  ".jpg", ".jpeg", ".bmp", ".tif",
                                                      ".tiff", ".pgm", ".ppm",  ".webp"};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

std::unique_ptr<FrameSource> openImageDirectory(const fs::path& directory, double fps) {
  return open(directory, fps, directory.string(), [](const std::string&) { return true; });
}

std::unique_ptr<FrameSource> openImagePattern(const std::string& pattern, double fps) {
  const fs::path path(pattern);
  const auto name = numberedName(path.filename().string());
  if (!name || path.parent_path().string().find('%') != std::string::npos)
    throw std::runtime_error(
        pattern + ": expected one number field in the file's name, as in frame-%05d.png");
  const fs::path directory = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  if (!fs::is_directory(directory)) throw std::runtime_error(pattern + ": no such directory");
  return open(directory, fps, pattern, [&](const std::string& file) { return name->fits(file); });
}

std::unique_ptr<FrameSource> openImage(const fs::path& file) {
  return std::make_unique<ImageSource>(std::vector<Picture>{{file, std::chrono::nanoseconds(0)}},
                                       false);
}

}  // namespace slamscope::tracking
