// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tracking/frame_source.hpp"
#include "tracking/rig.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

/// What the two eyes saw at about the same time; each frame has its own.
struct StereoFrame {
  /// Left, right. Absent: that eye has no camera, or it gave nothing (unplugged).
  std::array<std::optional<Frame>, 2> eyes;
};

/// Anything that hands out pictures for two eyes. Times of each eye increase strictly.
class StereoSource {
 public:
  virtual ~StereoSource() = default;

  /// The next pair, nothing at the end. At least one eye has a picture.
  [[nodiscard]] virtual std::optional<StereoFrame> next() = 0;

  [[nodiscard]] virtual std::size_t cameras() const { return 2; }  ///< 1: only the left eye's
  /// Rig and tags, where the source knows them (the lab does).
  [[nodiscard]] virtual std::optional<Rig> rig() const { return std::nullopt; }
  [[nodiscard]] virtual std::optional<TagLayout> tags() const { return std::nullopt; }
  [[nodiscard]] virtual bool live() const { return false; }    ///< as FrameSource::live
  [[nodiscard]] virtual bool stamped() const { return true; }  ///< as FrameSource::stamped
  [[nodiscard]] virtual std::optional<std::uint64_t> count() const { return std::nullopt; }
  /// What is wrong with the pair handed out last: "right camera: no frame within 2 s", "eyes are 21
  /// ms apart, more than half a frame", "left camera: a frame came out of order".
  [[nodiscard]] virtual std::vector<std::string> problems() const { return {}; }
};

/// Opens a camera; again after it was unplugged.
using EyeOpener = std::function<std::unique_ptr<FrameSource>()>;

/// Two cameras, or one (`right` empty). Frames are paired by time as well as they can be: an eye
/// that is behind by more than half a frame skips. Frames that don't go on in time are dropped. An
/// eye that fails is absent, and opened again every 30 pairs while the other goes on; when both
/// fail the error of the left one is thrown.
[[nodiscard]] std::unique_ptr<StereoSource> joinEyes(EyeOpener left, EyeOpener right = {});
/// A source whose frames hold both eyes side by side, left eye at x = 0. Throws std::runtime_error
/// for an odd width.
[[nodiscard]] std::unique_ptr<StereoSource> splitSideBySide(std::unique_ptr<FrameSource> source);

/// `LEFT,RIGHT`: two of what openFrameSource opens. One such: side by side where its frames are
/// more than 2.2 times as wide as high, else a single camera. Throws as openFrameSource.
[[nodiscard]] std::unique_ptr<StereoSource> openStereoSource(
    const std::string& spec, const FrameSourceOptions& options = {});

}  // namespace slamscope::tracking
