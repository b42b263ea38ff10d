// SPDX-License-Identifier: MIT
// The library that codecs() opens.
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "tracking/codecs.hpp"

namespace slamscope::tracking {
namespace {

std::optional<BgrPicture> pictureOf(const cv::Mat& image) {
  if (image.empty()) return std::nullopt;
  const cv::Mat packed = image.isContinuous() ? image : image.clone();
  return BgrPicture{.width = packed.cols,
                    .height = packed.rows,
                    .bgr = {packed.data, packed.data + packed.total() * packed.elemSize()}};
}

cv::Mat imageOf(const BgrPicture& picture) {
  return {picture.height, picture.width, CV_8UC3, const_cast<std::uint8_t*>(picture.bgr.data())};
}

class OpenCvReader final : public VideoReader {
 public:
  explicit OpenCvReader(cv::VideoCapture video) : video_(std::move(video)) {}

  std::optional<BgrPicture> next() override {
    if (!video_.read(image_)) return std::nullopt;
    return pictureOf(image_);
  }
  [[nodiscard]] double positionMs() const override { return video_.get(cv::CAP_PROP_POS_MSEC); }
  [[nodiscard]] double framesPerSecond() const override { return video_.get(cv::CAP_PROP_FPS); }
  [[nodiscard]] double count() const override { return video_.get(cv::CAP_PROP_FRAME_COUNT); }

 private:
  cv::VideoCapture video_;
  cv::Mat image_;
};

class OpenCvWriter final : public VideoWriter {
 public:
  explicit OpenCvWriter(cv::VideoWriter video) : video_(std::move(video)) {}

  void write(const BgrPicture& picture) override { video_.write(imageOf(picture)); }

 private:
  cv::VideoWriter video_;
};

class OpenCvCodecs final : public Codecs {
 public:
  [[nodiscard]] std::optional<BgrPicture> read(const std::filesystem::path& file) const override {
    return pictureOf(cv::imread(file.string(), cv::IMREAD_COLOR));
  }
  [[nodiscard]] std::optional<BgrPicture> decode(
      std::span<const std::uint8_t> bytes) const override {
    const cv::Mat packed(1, static_cast<int>(bytes.size()), CV_8U,
                         const_cast<std::uint8_t*>(bytes.data()));
    return pictureOf(cv::imdecode(packed, cv::IMREAD_COLOR));
  }
  [[nodiscard]] bool write(const std::filesystem::path& file,
                           const BgrPicture& picture) const override {
    try {
      return cv::imwrite(file.string(), imageOf(picture),
                         {cv::IMWRITE_PNG_COMPRESSION, 1, cv::IMWRITE_JPEG_QUALITY, 88});
    } catch (const cv::Exception&) {
      return false;
    }
  }
  [[nodiscard]] std::unique_ptr<VideoReader> openVideo(
      const std::filesystem::path& file) const override {
    cv::VideoCapture video(file.string(), cv::CAP_FFMPEG);
    if (!video.isOpened()) return nullptr;
    return std::make_unique<OpenCvReader>(std::move(video));
  }
  [[nodiscard]] std::unique_ptr<VideoWriter> createVideo(const std::filesystem::path& file,
                                                         double frames_per_second, int width,
                                                         int height) const override {
    cv::VideoWriter video;
    for (const int code :
         {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')})
      if (video.open(file.string(), cv::CAP_FFMPEG, code, frames_per_second, {width, height}))
        return std::make_unique<OpenCvWriter>(std::move(video));
    return nullptr;
  }
};

}  // namespace
}  // namespace slamscope::tracking

extern "C" const slamscope::tracking::Codecs* slamscope_codecs() {
  static const slamscope::tracking::OpenCvCodecs codecs;
  return &codecs;
}
