// SPDX-License-Identifier: MIT
#include "tests/experiments/tracking_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "tests/experiments/progress.hpp"
#include "tests/experiments/seen_tracking.hpp"
#include "tests/experiments/tracked_lab.hpp"
#include "tests/tracking/head_consistency.hpp"

namespace slamscope::tracking::experiments {
namespace {

/// One row; counts floors missed.
class Table {
 public:
  Table() {
    std::printf("%-5s %-58s %12s %12s %12s\n", "id", "figure", "floor", "aim", "measured");
  }
  /// Smaller is better.
  void atMost(const char* id, const char* what, double floor, double aim, double measured) {
    line(id, what, floor, aim, measured, measured <= floor, measured <= aim);
  }
  void atLeast(const char* id, const char* what, double floor, double aim, double measured) {
    line(id, what, floor, aim, measured, measured >= floor, measured >= aim);
  }
  void within(const char* id, const char* what, double low, double high, double measured) {
    const bool holds = measured > low && measured < high;
    line(id, what, low, high, measured, holds, holds);
  }
  [[nodiscard]] int missed() const { return missed_; }

 private:
  void line(const char* id, const char* what, double floor, double aim, double measured, bool holds,
            bool reached) {
    std::printf("%-5s %-58s %12.4g %12.4g %12.4g  %s\n", id, what, floor, aim, measured,
                !holds    ? "MISSED"
                : reached ? "aim"
                          : "floor");
    std::fflush(stdout);
    missed_ += holds ? 0 : 1;
  }
  int missed_ = 0;
};

/// f = 900 px at 1280 × 960, as the figures are stated.
StereoLabOptions fineLab() {
  StereoLabOptions options = defaultStereoLab();
  options.rig = defaultLabRig(2);
  for (RigCamera& camera : options.rig.cameras) camera.info.K(0, 0) = camera.info.K(1, 1) = 900;
  return options;
}

void addLabRows(Table& table, int frames) {
  StereoLabOptions still = fineLab();
  still.head = standingHead({.sway = 0});
  const TrackedLab static_walk = trackLab(still, frames);
  std::printf("      (at least %d tags used; cold start from pictures of 1280 x 960)\n",
              static_walk.least_tags);
  table.atMost("T4", "overlay, static, 2 m, f 900: p95, px", 1.0, 0.4,
               quantileOf(static_walk.overlay_px, 0.95));
  table.atMost("T14", "... vertical disparity of overlay against video: p95, px", 0.3, 0.1,
               quantileOf(static_walk.disparity_px, 0.95));
  for (const bool rolling : {false, true}) {
    StereoLabOptions quick = fineLab();
    quick.head = turningHead({.turn_rate = std::numbers::pi / 3, .turn_angle = 0.4});
    for (RigCamera& camera : quick.rig.cameras) {
      camera.readout = std::chrono::milliseconds(rolling ? 20 : 0);
    }
    const TrackedLab walk = trackLab(quick, frames);
    table.atMost("T5",
                 rolling ? "overlay, 60 deg/s + 0.5 m/s, rolling shutter 20 ms: p95, px"
                         : "overlay, 60 deg/s + 0.5 m/s, global shutter: p95, px",
                 2.0, 1.0, quantileOf(walk.overlay_px, 0.95));
    table.atMost("T14", "... vertical disparity of overlay against video: p95, px", 0.3, 0.1,
                 quantileOf(walk.disparity_px, 0.95));
    std::printf("      (%d of %d frames tracked, at least %d tags)\n", walk.tracked, walk.frames,
                walk.least_tags);
  }
  StereoLabOptions small = defaultStereoLab();
  small.head = standingHead({.sway = 0});
  const TrackedLab rest = trackLab(small, 2 * frames);
  const Jitter jitter = jitterOf(rest.T_world_head);
  std::printf("      (640 x 480, f 480, vision only, %d tags)\n", rest.least_tags);
  table.atMost("T7", "static jitter, RMS, deg", 0.03, 0.01, jitter.degrees);
  table.atMost("T7", "static jitter, RMS, mm", 1.0, 0.3, 1e3 * jitter.metres);
  table.atMost("T12", "cold start: both 640 x 480 pictures to a pose, ms", 100, 100, rest.first_ms);
  table.atMost("", "tracking a 640 x 480 picture, one thread: median, ms", 12, 4,
               quantileOf(rest.find_ms, 0.5) + quantileOf(rest.track_ms, 0.5) / 2);
}

/// T12 and its note. `asked`: of this motion the floors of the jump are asked.
void addRelocks(Table& table, const char* motion, const Relocks& gaps, bool asked) {
  constexpr double kAnything = std::numeric_limits<double>::infinity();
  std::printf("      (%d gaps of 1 to 10 frames, %s)\n", gaps.trials, motion);
  table.atLeast("T12", "tags back: pose in one frame, part", 1, 1,
                double(gaps.in_one_frame) / gaps.trials);
  table.atLeast("", "... jump within the 99.9 % of its covariance, part", asked ? 0.998 : 0, 1,
                double(gaps.within_covariance) / gaps.trials);
  table.atMost("", "... jump after gaps of up to 0.1 s: p95, px", asked ? 2 : kAnything, 2,
               quantileOf(gaps.jump_px, 0.95));
}

void addSeenRows(Table& table, int trials) {
  slam::experiments::Progress progress("consistency", trials);
  const auto nees = testing::headConsistency(trials, [&] { progress.done(); });
  const testing::Band pose = testing::neesBand(6, trials), overlay = testing::neesBand(2, trials);
  table.within("T8", "NEES of the pose, 6 degrees of freedom: 95 % band", pose.low, pose.high,
               nees.pose);
  table.within("T8", "NEES of the overlay's pixel, 2 degrees of freedom", overlay.low, overlay.high,
               nees.overlay);
  table.atLeast("T9", "60 % of the tags hidden: part of the frames tracked", 0.995, 0.999,
                trackedWithMostHidden(4 * trials));
  const LoneTags lone = loneTags(10 * trials);
  std::printf("      (%d lone tags: %d poses published, %d ambiguous)\n", lone.trials,
              lone.published, lone.ambiguous);
  table.atMost("T10", "wrong-branch poses published with a prior", 0, 0, lone.wrong);
  const SpoiltLayouts spoilt = spoiltLayouts(std::max(1, trials / 10));
  std::printf("      (%d layouts; %d other complaints)\n", spoilt.trials, spoilt.others_named);
  table.atLeast("T11", "wrong or moved tag rejected in one frame: part", 1, 1,
                double(spoilt.rejected_at_once) / spoilt.trials);
  table.atLeast("T11", "... and named within ten: part", 1, 1,
                double(spoilt.named) / spoilt.trials);
  constexpr double kSixty = std::numbers::pi / 3;
  addRelocks(table, "walking", relocks(trials / 4, walkingHead()), true);
  addRelocks(table, "turning to and fro at 60 deg/s",
             relocks(trials / 4, turningHead({.turn_rate = kSixty, .turn_angle = 0.4})), true);
  addRelocks(table, "turning to and fro at 120 deg/s",
             relocks(trials / 4, turningHead({.turn_rate = 2 * kSixty, .turn_angle = 0.6})), false);
  addRelocks(table, "glancing at 60 deg/s", relocks(trials / 4, glancingHead(kSixty, 0.8)), false);
  addRelocks(table, "glancing at 120 deg/s", relocks(trials / 4, glancingHead(2 * kSixty, 1.2)),
             false);
}

}  // namespace

int printTrackingTable(const TrackingTableOptions& options) {
  Table table;
  addSeenRows(table, options.trials);
  if (options.pictures) addLabRows(table, options.frames);
  return table.missed();
}

}  // namespace slamscope::tracking::experiments
