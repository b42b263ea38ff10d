// SPDX-License-Identifier: MIT
// What is stated wrongly of the room or the rig is named by the tracker.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tracking/seen_room.hpp"
#include "tests/tracking/seen_tags.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::atFrame, testing::SeenRoom;

/// What the tracker says of a room in which what is stated is wrong, after some frames.
struct Told {
  std::vector<std::string> problems;
  bool rejected_at_once = false;
  HeadState state = HeadState::searching;

  [[nodiscard]] bool names(const std::string& what) const {
    return std::any_of(problems.begin(), problems.end(), [&](const std::string& problem) {
      return problem.find(what) != std::string::npos;
    });
  }
};

Told tellOf(SeenRoom room, const TagLayout& stated, int rejected_id, int frames = 10) {
  HeadTracker tracker(room.rig, stated);
  Told told;
  for (int k = 0; k < frames; ++k) {
    tracker.add(room.pair(atFrame(k)));
    const auto& rejected = tracker.last().rejected_ids;
    if (k == 0) {
      told.rejected_at_once =
          std::find(rejected.begin(), rejected.end(), rejected_id) != rejected.end();
    }
  }
  told.problems = tracker.problems();
  told.state = tracker.state(atFrame(frames - 1));
  return told;
}

MappedTag& tagOf(TagLayout& layout, int id) {
  return *std::find_if(layout.tags.begin(), layout.tags.end(),
                       [id](const MappedTag& tag) { return tag.id == id; });
}

/// The tags that a head sees which stands at the start of its walk.
std::vector<int> inView(SeenRoom room) {
  std::vector<int> ids;
  for (const TagDetection& tag : room.picture(0, atFrame(0)).tags) ids.push_back(tag.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Figure T11.
TEST(HeadTrackerFaults, NamesTagsThatAreNotWhereTheLayoutHasThem) {
  SeenRoom room;
  room.head = standingHead();
  const auto ids = inView(room);
  ASSERT_GE(ids.size(), 4U);
  const int a = ids[0], b = ids[1];

  TagLayout moved = room.truth;
  tagOf(moved, a).T_world_tag.translation().x() += 0.01;
  const Told of_moved = tellOf(room, moved, a);
  EXPECT_TRUE(of_moved.rejected_at_once);
  EXPECT_TRUE(of_moved.names("tag " + std::to_string(a) + " has moved by 0.01"));
  EXPECT_EQ(of_moved.problems.size(), 1U);

  TagLayout swapped = room.truth;
  std::swap(tagOf(swapped, a).T_world_tag, tagOf(swapped, b).T_world_tag);
  const Told of_swapped = tellOf(room, swapped, a);
  EXPECT_TRUE(of_swapped.rejected_at_once);
  EXPECT_TRUE(of_swapped.names("tags " + std::to_string(a) + " and " + std::to_string(b) +
                               " are swapped in the layout"));

  TagLayout small = room.truth;
  tagOf(small, a).size_m *= 0.8;
  EXPECT_TRUE(tellOf(room, small, a).names("tag " + std::to_string(a) + " looks"));

  EXPECT_TRUE(tellOf(room, room.truth, a).problems.empty());
}

TEST(HeadTrackerFaults, RememberAMovedTagOutOfViewAndForgetOneThatWasPutBack) {
  SeenRoom room;
  room.head = standingHead();
  const int a = inView(room)[0];
  const TagLayout stated = room.truth;
  HeadTracker tracker(room.rig, stated);
  tagOf(room.truth, a).T_world_tag.translation().x() += 0.01;
  int frame = 0;
  const auto see = [&](int frames, bool in_view) {
    for (int k = 0; k < frames; ++k) {
      std::vector<HeadPicture> pair = room.pair(atFrame(frame++));
      for (HeadPicture& picture : pair) {
        std::erase_if(picture.tags, [&](const auto& tag) { return !in_view && tag.id == a; });
      }
      tracker.add(pair);
    }
  };
  see(7, true);
  ASSERT_EQ(tracker.problems().size(), 1U);
  see(20, false);
  EXPECT_EQ(tracker.problems().size(), 1U);
  room.truth = stated;
  see(4, true);
  EXPECT_EQ(tracker.problems().size(), 1U);
  see(1, true);  // five of ten are well now
  EXPECT_TRUE(tracker.problems().empty());
}

TEST(HeadTrackerFaults, NamesATagThatIsSeenTwice) {
  SeenRoom room;
  room.head = standingHead();
  const auto ids = inView(room);
  HeadTracker tracker(room.rig, room.truth);
  for (int k = 0; k < 8; ++k) {
    auto pictures = room.pair(atFrame(k));
    for (HeadPicture& picture : pictures) {
      TagDetection copy = picture.tags.front();
      copy.id = ids[0];
      for (auto& corner : copy.corners_px) corner += Vector2d(-20, 30);
      picture.tags.push_back(copy);
    }
    tracker.add(pictures);
    const auto e =
        testing::perturbation(tracker.at(atFrame(k))->motion.T_world_head, room.head(atFrame(k)));
    EXPECT_LT(e.norm(), 0.005);
  }
  ASSERT_EQ(tracker.problems().size(), 1U);
  EXPECT_EQ(tracker.problems()[0], "tag " + std::to_string(ids[0]) + " is seen twice");
}

TEST(HeadTrackerFaults, NamesWhatWasStatedWrongly) {
  SeenRoom room;
  constexpr int kFrames = 240;
  const auto tell = [&](const Rig& rig, const TagLayout& layout) {
    SeenRoom seen = room;
    HeadTracker tracker(rig, layout);
    for (int k = 0; k < kFrames; k += 6) tracker.add(seen.pair(atFrame(k)));
    return Told{tracker.problems(), false, tracker.state(atFrame(kFrames - 6))};
  };
  EXPECT_TRUE(tell(room.rig, room.truth).problems.empty());

  Rig longer = room.rig;
  for (RigCamera& camera : longer.cameras) camera.info.K.topLeftCorner<2, 2>() *= 1.03;
  EXPECT_TRUE(tell(longer, room.truth).names("focal length of the left camera looks"));

  Rig shifted = room.rig;
  for (RigCamera& camera : shifted.cameras) camera.info.K.topRightCorner<2, 1>().array() += 0.5;
  EXPECT_TRUE(tell(shifted, room.truth).names("principal point of the left camera looks"));

  TagLayout small = room.truth;
  for (MappedTag& tag : small.tags) tag.size_m *= 0.9;
  EXPECT_TRUE(tell(room.rig, small).names("tags look"));
}

}  // namespace
}  // namespace slamscope::tracking
