// SPDX-License-Identifier: MIT
#include "apps/lib/view/picture_output.hpp"

#include <algorithm>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "tracking/codecs.hpp"
#include "tracking/numbered_name.hpp"

namespace slamscope::apps {
namespace {

namespace fs = std::filesystem;

tracking::BgrPicture toBgr(const engine::Image& picture) {
  tracking::BgrPicture result{.width = picture.width, .height = picture.height, .bgr = {}};
  const cv::Mat rgba(picture.height, picture.width, CV_8UC4,
                     const_cast<std::uint8_t*>(picture.rgba.data()));
  result.bgr.resize(rgba.total() * 3);
  cv::Mat bgr(picture.height, picture.width, CV_8UC3, result.bgr.data());
  cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
  return result;
}

void requireFolder(const fs::path& target) {
  const fs::path folder = target.parent_path();
  if (!folder.empty() && !fs::is_directory(folder)) {
    throw std::runtime_error(target.string() + ": the folder " + folder.string() +
                             " does not exist; make it first");
  }
}

/// Where a file is written before it is whole: hidden, beside its place.
fs::path partialFor(const fs::path& target) {
  std::string name = target.stem().string();
  name.insert(0, 1, '.').append(".partial").append(target.extension().string());
  return target.parent_path() / name;
}

class NumberedPngs : public PictureOutput {
 public:
  explicit NumberedPngs(tracking::NumberedName name) : name_(std::move(name)) {}

  void write(const engine::Image& picture) override { writePicture(name_.of(next_++), picture); }
  void finish() override {}

 private:
  tracking::NumberedName name_;
  std::size_t next_ = 0;
};

class Video : public PictureOutput {
 public:
  Video(fs::path target, double frames_per_second)
      : target_(std::move(target)),
        partial_(partialFor(target_)),
        frames_per_second_(frames_per_second) {}
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;
  ~Video() override {
    writer_.reset();
    std::error_code ignored;
    fs::remove(partial_, ignored);
  }

  void write(const engine::Image& picture) override {
    if (!writer_) open(picture);
    if (picture.width != width_ || picture.height != height_) {
      throw std::runtime_error(target_.string() + ": a video's pictures have one size");
    }
    writer_->write(toBgr(picture));
  }

  void finish() override {
    if (!writer_) return;
    writer_.reset();
    fs::rename(partial_, target_);
  }

 private:
  void open(const engine::Image& picture) {
    width_ = picture.width;
    height_ = picture.height;
    if (width_ % 2 != 0 || height_ % 2 != 0) {
      throw std::runtime_error(target_.string() + ": a video needs an even width and height, not " +
                               std::to_string(width_) + " x " + std::to_string(height_) +
                               "; choose another --size");
    }
    writer_ = tracking::codecs().createVideo(partial_, frames_per_second_, width_, height_);
    if (!writer_) throw std::runtime_error(target_.string() + ": can't be written as a video");
  }

  fs::path target_, partial_;
  double frames_per_second_;
  int width_ = 0, height_ = 0;
  std::unique_ptr<tracking::VideoWriter> writer_;
};

}  // namespace

std::unique_ptr<PictureOutput> openPictureOutput(const fs::path& target, double frames_per_second) {
  requireFolder(target);
  const std::string name = target.string();
  if (target.extension() == ".mp4") return std::make_unique<Video>(target, frames_per_second);
  const auto numbered = tracking::numberedName(name);
  if (numbered && numbered->after.ends_with(".png")) {
    return std::make_unique<NumberedPngs>(*numbered);
  }
  throw std::runtime_error(
      name + ": --output takes NAME.mp4 or NAME-%05d.png; for the last picture alone --picture");
}

void writePicture(const fs::path& file, const engine::Image& picture) {
  requireFolder(file);
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".jpg") {
    throw std::runtime_error(file.string() + ": a picture is NAME.png or NAME.jpg");
  }
  const fs::path partial = partialFor(file);
  if (!tracking::codecs().write(partial, toBgr(picture)))
    throw std::runtime_error(file.string() + ": can't be written");
  fs::rename(partial, file);
}

engine::Image sideBySide(const engine::Image& left, const engine::Image& right, int gap_px) {
  if (left.height != right.height) throw std::invalid_argument("pictures of different height");
  engine::Image both;
  both.width = left.width + gap_px + right.width;
  both.height = left.height;
  both.rgba.assign(static_cast<std::size_t>(both.width) * static_cast<std::size_t>(both.height) * 4,
                   255);
  const auto place = [&both](const engine::Image& source, int x) {
    for (int row = 0; row < source.height; ++row) {
      std::copy_n(source.rgba.begin() + std::ptrdiff_t{row} * source.width * 4,
                  std::ptrdiff_t{source.width} * 4,
                  both.rgba.begin() + (std::ptrdiff_t{row} * both.width + x) * 4);
    }
  };
  place(left, 0);
  place(right, left.width + gap_px);
  return both;
}

}  // namespace slamscope::apps
