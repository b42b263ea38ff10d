// SPDX-License-Identifier: MIT
// Two eyes: sources with their faults, the lab's pictures against its truth, search, the robot.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/tracking/seen_room.hpp"
#include "tests/tracking/seen_tags.hpp"
#include "tracking/robot_in_room.hpp"
#include "tracking/stereo_lab.hpp"
#include "tracking/tag_search.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using std::chrono::milliseconds, std::chrono::nanoseconds;
using testing::atFrame, testing::SeenRoom;

/// Hands out frames of these times; at a negative one it fails once, as if unplugged.
class Script final : public FrameSource {
 public:
  explicit Script(std::vector<int> times_ms) : times_ms_(std::move(times_ms)) {}
  std::optional<Frame> next() override {
    if (at_ >= times_ms_.size()) return std::nullopt;
    const int time = times_ms_[at_++];
    if (time < 0) throw std::runtime_error("no frame within 2 s: unplugged?");
    return Frame{milliseconds(time), at_, "script", 4, 2, std::vector<std::uint8_t>(24, 7)};
  }

 private:
  std::vector<int> times_ms_;
  std::size_t at_ = 0;
};

EyeOpener script(std::vector<int> times) {
  return [times] { return std::make_unique<Script>(times); };
}

bool saysThat(const std::vector<std::string>& problems, const std::string& what) {
  return std::any_of(problems.begin(), problems.end(),
                     [&](const auto& p) { return p.find(what) != std::string::npos; });
}

TEST(StereoSource, PairsFramesOfAboutTheSameTime) {
  const auto source = joinEyes(script({0, 33, 66, 100, 133}), script({2, 68, 102, 135}));
  std::vector<std::pair<int, int>> pairs;
  while (const auto both = source->next()) {
    pairs.emplace_back(both->eyes[0]->time / milliseconds(1),
                       both->eyes[1]->time / milliseconds(1));
  }
  const std::vector<std::pair<int, int>> expected{{0, 2}, {66, 68}, {100, 102}, {133, 135}};
  EXPECT_EQ(pairs, expected) << "the right eye dropped one";
}

TEST(StereoSource, DoubledAndUnorderedFramesAreDroppedAndNamed) {
  const auto source = joinEyes(script({0, 33, 33, 66, 50, 100}), script({0, 33, 66, 100}));
  EXPECT_TRUE(source->next() && source->problems().empty());
  EXPECT_TRUE(source->next() && source->problems().empty());
  EXPECT_EQ(source->next()->eyes[0]->time, milliseconds(66));
  EXPECT_TRUE(saysThat(source->problems(), "left camera: a frame came twice"));
  EXPECT_EQ(source->next()->eyes[0]->time, milliseconds(100));
  EXPECT_TRUE(saysThat(source->problems(), "left camera: a frame came out of order"));
  EXPECT_FALSE(source->next());
}

TEST(StereoSource, FreeRunningEyesArePairedWithinHalfAFrameAndWhatIsFurtherApartIsNamed) {
  const auto free = joinEyes(script({0, 40, 80, 120, 160}), script({21, 61, 101, 141}));
  (void)free->next();  // how long a frame is isn't known yet
  while (const auto both = free->next()) {
    EXPECT_EQ(both->eyes[0]->time - both->eyes[1]->time, milliseconds(19));
    EXPECT_TRUE(free->problems().empty());
  }
  const auto stalled = joinEyes(script({0, 40, 80, 300}), script({0, 40, 110, 150}));
  (void)stalled->next();
  (void)stalled->next();
  EXPECT_TRUE(stalled->next());
  EXPECT_TRUE(saysThat(stalled->problems(), "eyes are 190 ms apart, more than half a frame"));
}

TEST(StereoSource, UnpluggedEyeIsAbsentAndComesBack) {
  std::vector<int> left;
  for (int k = 0; k < 80; ++k) left.push_back(33 * k);
  int opened = 0;
  const EyeOpener right = [&opened]() -> std::unique_ptr<FrameSource> {
    std::vector<int> times{0, 33, -1};
    if (opened++ > 0) times = {33 * 32, 33 * 33, 33 * 34, 33 * 35};
    return std::make_unique<Script>(times);
  };
  const auto source = joinEyes(script(left), right);
  int absent = 0, both = 0;
  while (const auto pair = source->next()) {
    ASSERT_TRUE(pair->eyes[0]);
    pair->eyes[1] ? ++both : ++absent;
    if (!pair->eyes[1]) {
      EXPECT_TRUE(saysThat(source->problems(), "right camera: no frame"));
    }
  }
  EXPECT_EQ(opened, 2);
  EXPECT_EQ(absent, 30);
  EXPECT_GE(both, 5);
}

TEST(StereoSource, BothUnpluggedIsAnError) {
  const auto source = joinEyes(script({0, -1}), script({0, -1}));
  EXPECT_TRUE(source->next());
  EXPECT_THROW((void)source->next(), std::runtime_error);
}

TEST(StereoSource, SideBySideFramesAreCutInTheMiddle) {
  class Wide final : public FrameSource {
    std::optional<Frame> next() override {
      Frame frame{nanoseconds(5), 0, "wide", 4, 1, {}};
      for (std::uint8_t i = 0; i < 12; ++i) frame.bgr.push_back(i);
      return frame;
    }
  };
  const auto pair = splitSideBySide(std::make_unique<Wide>())->next();
  EXPECT_EQ(pair->eyes[0]->bgr, (std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(pair->eyes[1]->bgr, (std::vector<std::uint8_t>{6, 7, 8, 9, 10, 11}));
}

/// A picture of the lab at 640 × 480; the head turns at 60 degrees a second, rolling shutter.
class LabWalk : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    StereoLabOptions options = defaultStereoLab();
    options.head = turningHead({.turn_rate = M_PI / 3, .turn_angle = 0.4});
    options.right_late = milliseconds(9);
    for (RigCamera& camera : options.rig.cameras) {
      camera.readout = milliseconds(20);
      camera.time_offset = milliseconds(-4);
    }
    lab_ = new StereoLab(options);
    both_ = new StereoFrame(lab_->pair(6));
  }
  static void TearDownTestSuite() {
    delete both_;
    delete lab_;
  }
  static inline StereoLab* lab_ = nullptr;
  static inline StereoFrame* both_ = nullptr;
};

TEST_F(LabWalk, CornersLieWhereTheTruthHasThemAtTheirRowsTime) {
  int corners = 0;
  double rms = 0, ignorant = 0;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const CameraInfo& info = lab_->options().rig.cameras[eye].info;
    TagDetector detector({.camera = CameraModel(info)});
    for (const TagDetection& tag : detector.detect(*both_->eyes[eye])) {
      const TagLayout layout = *lab_->tags();
      const MappedTag* mapped = layout.find(tag.id);
      if (!mapped || !tag.refined) continue;
      const auto p_tag = tagCorners(mapped->size_m);
      for (std::size_t i = 0; i < 4; ++i) {
        const Vector3d p = mapped->T_world_tag * p_tag[i];
        const auto truth = lab_->truePixel(eye, 6, p);
        ASSERT_TRUE(truth);
        rms += (tag.corners_px[i] - *truth).squaredNorm() / 2;
        const Isometry3d T_world_camera =
            lab_->T_world_head(lab_->time(eye, 6)) * lab_->options().rig.T_head_camera(eye);
        ignorant +=
            (tag.corners_px[i] - lab::projectByOpenCv(info, {T_world_camera.inverse() * p})[0])
                .squaredNorm() /
            2;
        ++corners;
      }
    }
  }
  ASSERT_GE(corners, 16);
  EXPECT_LT(std::sqrt(rms / corners), 0.2);
  EXPECT_GT(std::sqrt(ignorant / corners), 1) << "a global shutter's truth must not fit";
}

TEST_F(LabWalk, StampsAreTheTrueTimesLessTheOffsetAndEyesAreOutOfStep) {
  EXPECT_EQ(both_->eyes[0]->time, lab_->time(0, 6) + milliseconds(4));
  EXPECT_EQ(lab_->time(1, 6) - lab_->time(0, 6), milliseconds(9));
}

TEST_F(LabWalk, SameFrameToTheByteInAnyOrder) {
  EXPECT_EQ(lab_->frame(0, 6).bgr, both_->eyes[0]->bgr);
  EXPECT_NE(both_->eyes[1]->bgr, both_->eyes[0]->bgr);
}

TEST_F(LabWalk, SearchNearThePredictionFindsWhatTheWholePictureHolds) {
  TagSearch search(EyeCamera(lab_->options().rig, 0), *lab_->tags());
  EXPECT_GE(search.find(*both_->eyes[0], std::nullopt).size(), 3U);
  EXPECT_TRUE(search.whole());
  const CameraModel camera(lab_->options().rig.cameras[0].info);
  const auto whole = TagDetector({.camera = camera}).detect(*both_->eyes[0]);
  HeadMotion motion;
  const nanoseconds time = lab_->time(0, 6), step = milliseconds(1);
  const Isometry3d before = lab_->T_world_head(time - step),
                   after = lab_->T_world_head(time + step);
  motion.T_world_head = lab_->T_world_head(time);
  motion.v_world = (after.translation() - before.translation()) / 0.002;
  motion.omega_head = rotationLog(before.linear().transpose() * after.linear()) / 0.002;
  const auto near = search.find(*both_->eyes[0], motion);
  EXPECT_FALSE(search.whole());
  std::vector<int> of_whole, of_near;
  for (const auto& tag : whole) {
    if (lab_->tags()->find(tag.id)) of_whole.push_back(tag.id);
  }
  for (const auto& tag : near) of_near.push_back(tag.id);
  EXPECT_EQ(of_near, of_whole);
  EXPECT_EQ(search.problem(), "");
}

TEST_F(LabWalk, MirroredPictureIsNamed) {
  const Frame& frame = *both_->eyes[0];
  Frame mirror = frame;
  for (int row = 0; row < frame.height; ++row) {
    for (int column = 0; column < frame.width; ++column) {
      for (int c = 0; c < 3; ++c) {
        mirror.bgr[std::size_t(3 * (row * frame.width + column) + c)] =
            frame.bgr[std::size_t(3 * (row * frame.width + frame.width - 1 - column) + c)];
      }
    }
  }
  TagSearch search(EyeCamera(lab_->options().rig, 0), *lab_->tags());
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(search.find(mirror, std::nullopt).empty());
  EXPECT_EQ(search.problem(), "the picture is mirrored");
}

TEST(RobotInRoom, IsFoundOnTheFloorWithAnHonestCovariance) {
  double nees = 0;
  constexpr int kRuns = 100;
  SeenRoom room;
  room.head = walkingHead();
  const Isometry3d T_world_map =
      Eigen::Translation3d(0.3, -0.2, 0) * Isometry3d(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
  RobotTag tag;
  SeenRoom with_robot = room;
  with_robot.truth.tags.push_back({0, tag.size_m, T_world_map * tag.T_robot_tag});
  with_robot.least_side_px = 15;
  for (int run = 0; run < kRuns; ++run) {
    with_robot.random.seed(unsigned(run));
    HeadTracker tracker(room.rig, room.truth, {.corner_bias_px = 0});
    RobotInRoom robot(room.rig, tag, 1);
    const auto pictures = with_robot.pair(atFrame(0));
    tracker.add(pictures);
    robot.add(*tracker.at(atFrame(0)), pictures[0]);
    ASSERT_TRUE(robot.place()) << robot.status();
    const auto e = testing::perturbation(robot.place()->T_world_map, T_world_map);
    const Vector3d off(e[0], e[1], e[5]);
    EXPECT_LT(off.head<2>().norm(), 0.01);
    nees += testing::nees(off, robot.place()->covariance) / kRuns;
  }
  // Corner noise is stated a little larger than it is (bias), hence the one-sided look.
  EXPECT_LT(nees, testing::neesBand(3, kRuns).high);
  EXPECT_GT(nees, 1.5);
}

TEST(RobotInRoom, NamesATagOfAnotherSizeAndWaitsForARobotThatStands) {
  SeenRoom room;
  RobotTag tag;
  SeenRoom with_robot = room;
  with_robot.least_side_px = 15;
  with_robot.truth.tags.push_back({0, 0.17, tag.T_robot_tag});
  HeadTracker tracker(room.rig, room.truth);
  RobotInRoom robot(room.rig, tag, 10);
  auto pictures = with_robot.pair(atFrame(0));
  tracker.add(pictures);
  robot.add(*tracker.at(atFrame(0)), pictures[0]);
  EXPECT_FALSE(robot.place());
  EXPECT_TRUE(saysThat(robot.problems(), "robot's tag 0 looks 0.17"));

  RobotInRoom moving(room.rig, tag, 10);
  for (int k = 1; k < 30; ++k) {
    with_robot.truth.tags.back() = {0, 0.2, Eigen::Translation3d(0.05 * k, 0, 0) * tag.T_robot_tag};
    pictures = with_robot.pair(atFrame(k));
    tracker.add(pictures);
    moving.add(*tracker.at(atFrame(k)), pictures[0]);
  }
  EXPECT_FALSE(moving.place());
}

}  // namespace
}  // namespace slamscope::tracking
