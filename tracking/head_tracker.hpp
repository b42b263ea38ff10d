// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/head_motion.hpp"
#include "tracking/rig.hpp"
#include "tracking/tag_detector.hpp"
#include "tracking/tag_layout.hpp"

namespace slamscope::tracking {

enum class HeadState {
  searching,  ///< no pose: no tags yet, or none for longer than may be coasted
  ambiguous,  ///< two poses fit what was seen, and nothing decides yet
  tracking,
  coasting  ///< no tags now: predicted from the motion before, ever less certain
};
[[nodiscard]] const char* name(HeadState state);

/// What one camera saw.
struct HeadPicture {
  std::size_t camera = 0;           ///< of the rig: 0 left, 1 right
  std::chrono::nanoseconds time{};  ///< the frame's stamp; the rig's time_offset is added inside
  std::vector<TagDetection> tags;   ///< all; those that aren't in the layout are passed over
};

/// Where the head is at a time.
struct HeadPose {
  HeadState state = HeadState::searching;
  HeadMotion motion;  ///< of that time, with covariance
  /// When ambiguous: the pose that fits second best.
  std::optional<Eigen::Isometry3d> other_T_world_head;
  std::chrono::nanoseconds age{};  ///< since the last picture with tags that counted
};

/// What came of the pictures added last.
struct HeadFix {
  std::chrono::nanoseconds time{};  ///< mid-exposure of the latest of them
  HeadState state = HeadState::searching;
  int tags_seen = 0, tags_used = 0;  ///< of the layout; a tag in both eyes counts once
  int corners_used = 0;
  double residual_px = 0;  ///< RMS distance of the used corners from where the pose projects them
  std::vector<int> rejected_ids;  ///< tags that don't fit the rest
  /// Squared Mahalanobis distance of the new pose from the predicted one, χ² with 6 degrees of
  /// freedom where all is well; absent where nothing was predicted.
  std::optional<double> surprise;
  bool relocked = false;  ///< found anew: there was no pose, or it was not believed any more
};

struct HeadTrackerOptions {
  HeadNoise noise = {};
  /// What is the same in many frames and so is not averaged out: bias of a corner, place of a tag
  /// in the layout; px per axis, added to each corner's sigma.
  double corner_bias_px = 0.02;
  double gate_sigmas = 6;  ///< corners further off are outliers (and at least 0.5 px)
  std::chrono::nanoseconds coast_limit{500'000'000};  ///< then: searching
  std::chrono::nanoseconds history{1'000'000'000};    ///< how late a picture may come
  /// Heads are above the floor (z > 0) and nobody stands on theirs: where two poses fit, one that
  /// is below the floor, upside down or rolled by more than this (of the left camera) is not the
  /// one. 0: no such rule (a world whose z is not up).
  double most_roll = 1.2;  ///< rad
};

/// The pose of a head from tags of known place in its cameras' pictures.
///
/// Each picture counts at its own mid-exposure, each corner at its row's: pictures may come late
/// and in any order within `history`, what came after them is then done again. Between pictures the
/// head moves with constant velocity but for white noise (HeadNoise); the filter's errors are those
/// of HeadMotion. Own time does not exist: states and predictions are of the times passed in.
///
///     HeadTracker tracker(readRig("rig.yaml"), readTagLayout("tags.yaml"));
///     tracker.add({{{0, left.time, detect(left)}, {1, right.time, detect(right)}}});
///     if (auto pose = tracker.at(left.time)) draw(pose->motion.T_world_head, name(pose->state));
///
/// The seam for an inertial sensor is head_motion.hpp: `predicted` with measured rates in place of
/// constant ones; buffer, update and states don't know how the head got from one time to the next.
class HeadTracker {
 public:
  /// Throws std::invalid_argument: no camera, more than two, no tag in the layout, a wrong camera.
  HeadTracker(Rig rig, TagLayout layout, HeadTrackerOptions options = {});
  ~HeadTracker();
  HeadTracker(HeadTracker&&) noexcept;
  HeadTracker& operator=(HeadTracker&&) noexcept;

  /// Pictures of about one moment (both eyes, or one). Those exposed together are fitted together,
  /// others each at its own time. Doubled and too late ones are dropped, and problems() says so.
  /// Throws std::out_of_range for a camera that the rig doesn't have.
  void add(std::span<const HeadPicture> pictures);
  void add(const HeadPicture& picture) { add(std::span(&picture, 1)); }

  /// The head at a time: of a picture that was added, with all that is known up to it; after the
  /// last picture, predicted. Nothing while searching, or before the history begins.
  [[nodiscard]] std::optional<HeadPose> at(std::chrono::nanoseconds time) const;
  /// The state as of a time; tracking turns into coasting, and that into searching, by time alone.
  [[nodiscard]] HeadState state(std::chrono::nanoseconds time) const;
  [[nodiscard]] const HeadFix& last() const;

  /// What is wrong, named, as long as it lasts: "tag 3 has moved by 0.010 m", "tags 3 and 4 are
  /// swapped in the layout", "tag 3 is seen twice", "right camera: frames come out of order",
  /// "eyes are 21 ms apart, more than half a frame", "focal length of the left camera looks 2.1 %
  /// too long"… Empty when all is well.
  [[nodiscard]] std::vector<std::string> problems() const;
  /// One line: "tracking: 7 of 8 tags, residual 0.08 px, head ±0.6 mm ±0.02°".
  [[nodiscard]] std::string status(std::chrono::nanoseconds time) const;

  [[nodiscard]] const Rig& rig() const;
  [[nodiscard]] const TagLayout& layout() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::tracking
