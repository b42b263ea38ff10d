// SPDX-License-Identifier: MIT
#include "tracking/stereo_source.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace slamscope::tracking {
namespace {

using std::chrono::nanoseconds;

constexpr int kTryAgain = 30;  // pairs
constexpr double kSideBySide = 2.2;

/// One eye's camera, which may fail and come back.
class Eye {
 public:
  Eye(EyeOpener open, std::string name) : open_(std::move(open)), name_(std::move(name)) {
    source_ = open_();
    live_ = source_->live();
    stamped_ = source_->stamped();
  }

  /// The next frame that goes on in time; nothing at the end, or where the camera fails.
  std::optional<Frame> next(std::vector<std::string>& problems) {
    if (!source_ && !reopen(problems)) return std::nullopt;
    try {
      while (auto frame = source_->next()) {
        if (!last_ || frame->time > *last_) {
          if (last_) interval_ = shorter(frame->time - *last_);
          last_ = frame->time;
          return frame;
        }
        problems.push_back(name_ + (frame->time == *last_ ? ": a frame came twice"
                                                          : ": a frame came out of order"));
      }
      ended_ = true;
    } catch (const std::runtime_error& error) {
      fail(error, problems);
    }
    return std::nullopt;
  }

  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] bool failed() const { return !source_; }
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] nanoseconds interval() const { return interval_; }  ///< of frames; 0: not known
  [[nodiscard]] bool live() const { return live_; }
  [[nodiscard]] bool stamped() const { return stamped_; }
  [[nodiscard]] std::optional<std::uint64_t> count() const {
    return source_ ? source_->count() : std::nullopt;
  }

 private:
  void fail(const std::runtime_error& error, std::vector<std::string>& problems) {
    failure_ = name_ + ": " + error.what();
    problems.push_back(failure_);
    source_.reset();
    waited_ = 0;
  }

  bool reopen(std::vector<std::string>& problems) {
    if (++waited_ < kTryAgain) {
      problems.push_back(failure_);
      return false;
    }
    try {
      source_ = open_();
      return true;
    } catch (const std::runtime_error& error) {
      fail(error, problems);
      return false;
    }
  }

  [[nodiscard]] nanoseconds shorter(nanoseconds since) const {
    return interval_.count() == 0 ? since : std::min(interval_, since);
  }

  EyeOpener open_;
  std::string name_, failure_;
  std::unique_ptr<FrameSource> source_;
  std::optional<nanoseconds> last_;
  nanoseconds interval_{0};
  int waited_ = 0;
  bool ended_ = false, live_ = false, stamped_ = true;
};

class JoinedEyes final : public StereoSource {
 public:
  JoinedEyes(EyeOpener left, EyeOpener right) {
    eyes_.emplace_back(std::move(left), right ? "left camera" : "camera");
    if (right) eyes_.emplace_back(std::move(right), "right camera");
  }

  std::optional<StereoFrame> next() override {
    problems_.clear();
    for (;;) {
      StereoFrame both;
      for (std::size_t i = 0; i < eyes_.size(); ++i) both.eyes[i] = eyes_[i].next(problems_);
      if (std::any_of(eyes_.begin(), eyes_.end(), [](const Eye& e) { return e.ended(); })) {
        return std::nullopt;
      }
      if (std::all_of(eyes_.begin(), eyes_.end(), [](const Eye& e) { return e.failed(); })) {
        throw std::runtime_error(eyes_.front().failure());
      }
      if (both.eyes[0] && both.eyes[1]) bringTogether(both);
      if (both.eyes[0] || both.eyes[1]) return both;
    }
  }

  std::size_t cameras() const override { return eyes_.size(); }
  bool live() const override { return eyes_.front().live(); }
  bool stamped() const override { return eyes_.front().stamped(); }
  std::optional<std::uint64_t> count() const override { return eyes_.front().count(); }
  std::vector<std::string> problems() const override { return problems_; }

 private:
  /// The eye that is behind skips frames until it is not, or no frame comes nearer.
  void bringTogether(StereoFrame& both) {
    const nanoseconds interval = std::max(eyes_[0].interval(), eyes_[1].interval());
    constexpr int kMostSkipped = 100;
    for (int i = 0; i < kMostSkipped && interval.count() > 0; ++i) {
      const nanoseconds ahead = both.eyes[1]->time - both.eyes[0]->time;
      if (std::chrono::abs(ahead) * 2 <= interval) return;
      const std::size_t behind = ahead.count() > 0 ? 0 : 1;
      auto frame = eyes_[behind].next(problems_);
      if (!frame) break;
      const nanoseconds apart = std::chrono::abs(frame->time - both.eyes[1 - behind]->time);
      const bool passed =
          behind == 0 ? frame->time > both.eyes[1]->time : frame->time > both.eyes[0]->time;
      both.eyes[behind] = std::move(frame);
      if (passed && apart * 2 > interval) break;  // out of step for good
    }
    const nanoseconds apart = std::chrono::abs(both.eyes[1]->time - both.eyes[0]->time);
    if (interval.count() > 0 && apart * 2 > interval) {
      problems_.push_back("eyes are " + std::to_string((apart.count() + 500'000) / 1'000'000) +
                          " ms apart, more than half a frame");
    }
  }

  std::vector<Eye> eyes_;
  std::vector<std::string> problems_;
};

class SideBySide final : public StereoSource {
 public:
  explicit SideBySide(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  std::optional<StereoFrame> next() override {
    const auto frame = source_->next();
    if (!frame) return std::nullopt;
    if (frame->width % 2 != 0) {
      throw std::runtime_error(frame->source + ": " + std::to_string(frame->width) +
                               " px wide; two pictures side by side have an even width");
    }
    StereoFrame both;
    for (std::size_t eye = 0; eye < 2; ++eye) both.eyes[eye] = half(*frame, eye);
    return both;
  }

  bool live() const override { return source_->live(); }
  bool stamped() const override { return source_->stamped(); }
  std::optional<std::uint64_t> count() const override { return source_->count(); }

 private:
  static Frame half(const Frame& frame, std::size_t eye) {
    Frame one{frame.time, frame.sequence, frame.source, frame.width / 2, frame.height, {}};
    const std::size_t bytes = static_cast<std::size_t>(one.width) * 3;
    one.bgr.resize(bytes * static_cast<std::size_t>(one.height));
    for (int row = 0; row < one.height; ++row) {
      const auto at = static_cast<std::size_t>(row);
      std::memcpy(one.bgr.data() + at * bytes, frame.bgr.data() + (2 * at + eye) * bytes, bytes);
    }
    return one;
  }

  std::unique_ptr<FrameSource> source_;
};

/// A source of which one frame was looked at already.
class LookedAt final : public FrameSource {
 public:
  LookedAt(std::unique_ptr<FrameSource> source, std::optional<Frame> first)
      : source_(std::move(source)), first_(std::move(first)) {}
  std::optional<Frame> next() override {
    if (!first_) return source_->next();
    auto frame = std::move(first_);
    first_.reset();
    return frame;
  }
  std::optional<CameraInfo> cameraInfo() const override { return source_->cameraInfo(); }
  bool live() const override { return source_->live(); }
  bool stamped() const override { return source_->stamped(); }
  std::optional<std::uint64_t> count() const override { return source_->count(); }

 private:
  std::unique_ptr<FrameSource> source_;
  std::optional<Frame> first_;
};

}  // namespace

std::unique_ptr<StereoSource> joinEyes(EyeOpener left, EyeOpener right) {
  return std::make_unique<JoinedEyes>(std::move(left), std::move(right));
}

std::unique_ptr<StereoSource> splitSideBySide(std::unique_ptr<FrameSource> source) {
  return std::make_unique<SideBySide>(std::move(source));
}

std::unique_ptr<StereoSource> openStereoSource(const std::string& spec,
                                               const FrameSourceOptions& options) {
  const auto opener = [options](const std::string& one) -> EyeOpener {
    return [one, options] { return openFrameSource(one, options); };
  };
  const std::size_t comma = spec.find(',');
  if (comma != std::string::npos) {
    return joinEyes(opener(spec.substr(0, comma)), opener(spec.substr(comma + 1)));
  }
  auto source = openFrameSource(spec, options);
  auto first = source->next();
  const bool wide = first && first->width > kSideBySide * first->height;
  auto whole = std::make_unique<LookedAt>(std::move(source), std::move(first));
  if (wide) return splitSideBySide(std::move(whole));
  // The source that was looked at is the first that is handed out; a later one is opened anew.
  auto held = std::make_shared<std::unique_ptr<FrameSource>>(std::move(whole));
  return joinEyes([held, again = opener(spec)] { return *held ? std::move(*held) : again(); });
}

}  // namespace slamscope::tracking
