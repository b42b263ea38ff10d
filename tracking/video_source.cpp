// SPDX-License-Identifier: MIT
#include "tracking/video_source.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "tracking/codecs.hpp"
#include "tracking/frame_source.hpp"
#include "tracking/stamps.hpp"

namespace slamscope::tracking {
namespace {

class VideoSource final : public FrameSource {
 public:
  VideoSource(const std::filesystem::path& file, double fps)
      : name_(file.string()), fps_(fps), video_(codecs().openVideo(file)) {
    if (!video_) throw std::runtime_error(name_ + ": can't be read as a video");
  }

  std::optional<Frame> next() override {
    std::optional<BgrPicture> picture = video_->next();
    if (!picture) {
      if (next_ == 0) throw std::runtime_error(name_ + ": no frame in it");
      return std::nullopt;
    }
    if (next_ > 0 && (picture->width != width_ || picture->height != height_))
      throw std::runtime_error(name_ + ", frame " + std::to_string(next_) +
                               ": the picture's size changes");
    width_ = picture->width;
    height_ = picture->height;
    return Frame{.time = stamp(),
                 .sequence = next_++,
                 .source = name_,
                 .width = width_,
                 .height = height_,
                 .bgr = std::move(picture->bgr)};
  }
  bool stamped() const override { return fps_ <= 0; }
  std::optional<std::uint64_t> count() const override {
    const double count = video_->count();
    if (!(count > 0)) return std::nullopt;
    return static_cast<std::uint64_t>(count);
  }

 private:
  /// Of the frame just read. A stream whose clock stands still or goes back is counted on from
  /// there.
  std::chrono::nanoseconds stamp() {
    if (fps_ > 0) return timeAtRate(next_, fps_);
    const double own_rate = video_->framesPerSecond();
    const std::chrono::nanoseconds step = timeAtRate(1, own_rate > 0 ? own_rate : 30);
    const std::chrono::nanoseconds clock(std::llround(video_->positionMs() * 1e6));
    last_ = next_ > 0 && clock <= last_ ? last_ + step : clock;
    return last_;
  }

  std::string name_;
  double fps_;
  std::unique_ptr<VideoReader> video_;
  std::uint64_t next_ = 0;
  std::chrono::nanoseconds last_{};
  int width_ = 0, height_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> openVideo(const std::filesystem::path& file, double fps) {
  return std::make_unique<VideoSource>(file, fps);
}

}  // namespace slamscope::tracking
