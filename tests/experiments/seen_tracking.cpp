// SPDX-License-Identifier: MIT
#include "tests/experiments/seen_tracking.hpp"

#include <algorithm>
#include <cmath>

#include "tests/experiments/progress.hpp"
#include "tests/tracking/seen_room.hpp"
#include "tracking/head_overlay.hpp"

namespace slamscope::tracking::experiments {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using slam::experiments::Progress;
using testing::atFrame, testing::SeenRoom;

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 errorOf(const HeadMotion& found, const Isometry3d& truth) {
  HeadMotion to = found;
  to.T_world_head = truth;
  return difference(found, to).head<6>();
}

bool names(const HeadTracker& tracker, const std::string& what) {
  const auto problems = tracker.problems();
  return std::any_of(problems.begin(), problems.end(),
                     [&](const auto& p) { return p.find(what) != std::string::npos; });
}

MappedTag& tagOf(TagLayout& layout, int id) {
  return *std::find_if(layout.tags.begin(), layout.tags.end(),
                       [id](const MappedTag& tag) { return tag.id == id; });
}

constexpr int kFramesToName = 10;

/// Ids that the left eye sees at a frame, in random order.
std::vector<int> seenAt(SeenRoom& room, int frame) {
  std::vector<int> ids;
  for (const TagDetection& tag : room.picture(0, atFrame(frame)).tags) ids.push_back(tag.id);
  return ids;
}

/// Those of `ids` that stay in view for all the frames in which they have to be named.
std::vector<int> staying(SeenRoom& room, int frame, std::vector<int> ids) {
  for (int k = 1; k < kFramesToName; ++k) {
    const std::vector<int> seen = seenAt(room, frame + k);
    std::erase_if(ids,
                  [&](int id) { return std::find(seen.begin(), seen.end(), id) == seen.end(); });
  }
  return ids;
}

/// Ten frames with a layout that isn't the room's; counts what is said of `bad`: one of `sayings`.
void judge(SeenRoom& room, const TagLayout& stated, int frame, int bad,
           const std::vector<std::string>& sayings, SpoiltLayouts& result) {
  HeadTracker tracker(room.rig, stated);
  for (int k = 0; k < kFramesToName; ++k) {
    tracker.add(room.pair(atFrame(frame + k)));
    const auto& rejected = tracker.last().rejected_ids;
    if (k == 0 && std::find(rejected.begin(), rejected.end(), bad) != rejected.end()) {
      ++result.rejected_at_once;
    }
  }
  ++result.trials;
  const bool named = std::any_of(sayings.begin(), sayings.end(),
                                 [&](const auto& saying) { return names(tracker, saying); });
  result.named += named ? 1 : 0;
  result.others_named += static_cast<int>(tracker.problems().size()) - (named ? 1 : 0);
}

}  // namespace

double trackedWithMostHidden(int frames) {
  SeenRoom room;
  room.hidden = 0.6;
  room.least_tags = 2;
  HeadTracker tracker(room.rig, room.truth);
  Progress progress("hidden tags", frames);
  int tracked = 0;
  for (int k = 0; k < frames; ++k) {
    tracker.add(room.pair(atFrame(k)));
    progress.done();
    const auto pose = tracker.at(atFrame(k));
    if (!pose || pose->state != HeadState::tracking) continue;
    const Vector6 e = errorOf(pose->motion, room.head(atFrame(k)));
    if (e.head<3>().norm() < 0.02 && e.tail<3>().norm() < 0.01) ++tracked;
  }
  return static_cast<double>(tracked) / frames;
}

LoneTags loneTags(int trials) {
  SeenRoom room;
  room.rig.cameras.resize(1);
  room.sigma_px = 0.2;
  LoneTags result;
  Progress progress("lone tags", trials);
  for (; result.trials < trials; ++result.trials) {
    room.random.seed(static_cast<unsigned>(result.trials));
    const int frame = 3 * result.trials % 750;
    HeadTracker tracker(room.rig, room.truth);
    room.most_tags = 100;
    for (int k = 0; k < 3; ++k) tracker.add(room.pair(atFrame(frame + k)));
    room.most_tags = 1;
    for (int k = 3; k < 6; ++k) tracker.add(room.pair(atFrame(frame + k)));
    progress.done();
    const auto pose = tracker.at(atFrame(frame + 5));
    if (!pose) continue;
    if (pose->state == HeadState::ambiguous) ++result.ambiguous;
    if (pose->state != HeadState::tracking) continue;
    ++result.published;
    if (errorOf(pose->motion, room.head(atFrame(frame + 5))).tail<3>().norm() > 0.1) ++result.wrong;
  }
  return result;
}

SpoiltLayouts spoiltLayouts(int places) {
  SeenRoom room;
  SpoiltLayouts result;
  Progress progress("spoilt layouts", places);
  for (int i = 0; i < places; ++i) {
    progress.done();
    const int frame = 7 * i;
    const std::vector<int> seen = seenAt(room, frame);
    const std::vector<int> ids = staying(room, frame, seen);
    if (seen.size() < 4 || ids.empty()) continue;
    const int a = ids[0], b = seen[0] == a ? seen[1] : seen[0];
    const std::string tag = "tag " + std::to_string(a);
    TagLayout moved = room.truth;
    const Isometry3d shift(Eigen::Translation3d(i % 2 == 0 ? 0.01 : 0, i % 2 == 0 ? 0 : 0.01, 0));
    tagOf(moved, a).T_world_tag = tagOf(moved, a).T_world_tag * shift;
    judge(room, moved, frame, a, {tag + " has moved"}, result);
    TagLayout swapped = room.truth;
    std::swap(tagOf(swapped, a).T_world_tag, tagOf(swapped, b).T_world_tag);
    const std::string both =
        std::to_string(std::min(a, b)) + " and " + std::to_string(std::max(a, b));
    // The other one may be out of view.
    judge(room, swapped, frame, a,
          {"tags " + both, tag + " stands in the place of tag " + std::to_string(b)}, result);
    TagLayout small = room.truth;
    tagOf(small, a).size_m *= 0.85;
    judge(room, small, frame, a, {tag + " looks"}, result);
  }
  return result;
}

Relocks relocks(int trials, const HeadPath& head) {
  SeenRoom room;
  room.head = head;
  const EyeCamera eye(room.rig, 0);
  HeadTracker tracker(room.rig, room.truth);
  Relocks result;
  Progress progress("gaps", trials);
  int frame = 0;
  for (; result.trials < trials; ++result.trials) {
    const int gap = 1 + result.trials % 10;
    for (int k = 0; k < 6; ++k) tracker.add(room.pair(atFrame(++frame)));
    for (int k = 0; k < gap; ++k) tracker.add(HeadPicture{0, atFrame(++frame), {}});
    const auto before = tracker.at(atFrame(++frame));
    tracker.add(room.pair(atFrame(frame)));
    const auto after = tracker.at(atFrame(frame));
    progress.done();
    if (!before || !after || after->state != HeadState::tracking) continue;
    ++result.in_one_frame;
    if (tracker.last().surprise && *tracker.last().surprise < 22.46) ++result.within_covariance;
    if (gap > 2) continue;
    for (double x = -0.8; x < 0.81; x += 0.4) {
      const auto a = projectRolling(eye, before->motion, {x, x / 2, 0});
      const auto b = projectRolling(eye, after->motion, {x, x / 2, 0});
      if (a && b) result.jump_px.push_back((*a - *b).norm());
    }
  }
  return result;
}

HeadPath glancingHead(double peak_rate, double angle) {
  constexpr double kPeak = 1.875;  // of a minimum-jerk turn, over its mean rate
  const double lasts = kPeak * angle / peak_rate;
  return [=](std::chrono::nanoseconds time) {
    const double t = std::chrono::duration<double>(time).count();
    double begins = 0, from = -angle / 2;
    for (int turn = 0;; ++turn, from = -from) {
      begins += 0.5 + 0.3 * std::sin(7.0 * turn);  // the rest before it
      const double s = std::clamp((t - begins) / lasts, 0.0, 1.0);
      if (s == 1) {
        begins += lasts;
        continue;
      }
      const double part = s * s * s * (10 - s * (15 - 6 * s));
      Isometry3d T = walkingHead()(time);
      T.linear() = Eigen::AngleAxisd(from * (1 - 2 * part), Vector3d::UnitZ()).toRotationMatrix() *
                   T.linear();
      return T;
    }
  };
}

}  // namespace slamscope::tracking::experiments
