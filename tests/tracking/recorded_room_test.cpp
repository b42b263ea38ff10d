// SPDX-License-Identifier: MIT
// Layout, tracking and stereo calibration by real pictures, where they are at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/tracking/recorded.hpp"
#include "tests/tracking/seen_room.hpp"
#include "tracking/camera_calibration.hpp"
#include "tracking/head_overlay.hpp"
#include "tracking/room_calibration.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::atFrame, testing::detect, testing::recorded, testing::Sequence;

constexpr std::size_t kFrames = 50;
constexpr double kTagSize = 0.0955;

/// A camera moved by hand before a board of twelve tags, ten of them in view; detected and
/// calibrated once.
class RecordedBoard : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const auto folder = recorded("visp_sequence");
    if (!folder) return;
    camera_ = new CameraModel(Sequence::intrinsics(*folder));
    pictures_ = new std::vector<RoomPicture>;
    TagDetector detector({.camera = *camera_});
    for (std::size_t k = 0; k < kFrames; ++k) {
      pictures_->push_back({0, detect(detector, *folder / Sequence::picture(k))});
    }
    room_ = new RoomCalibration(
        calibrateRoom(std::span(camera_, 1), *pictures_, {.size_m = kTagSize, .gauge = 5}));
  }
  static void TearDownTestSuite() {
    delete camera_;
    delete pictures_;
    delete room_;
  }
  void SetUp() override {
    if (!room_) GTEST_SKIP() << "no recorded data: visp_sequence";
  }

  static Rig rig() {
    Rig rig;
    rig.cameras.push_back({.info = camera_->info(), .display = {}});
    return rig;
  }
  static bool names(const HeadTracker& tracker, const std::string& what) {
    const auto problems = tracker.problems();
    return std::any_of(problems.begin(), problems.end(),
                       [&](const auto& p) { return p.find(what) != std::string::npos; });
  }

  static inline CameraModel* camera_ = nullptr;
  static inline std::vector<RoomPicture>* pictures_ = nullptr;
  static inline RoomCalibration* room_ = nullptr;
};

TEST_F(RecordedBoard, WalkGivesAFlatRegularBoard) {
  ASSERT_EQ(room_->layout.tags.size(), 10U) << "0 to 10 without 7, which stands behind something";
  EXPECT_LT(room_->residual_px, 0.3);
  // Best regular grid: place = a + column b + row c, four tags a row.
  Eigen::Matrix<double, 10, 3> A, B;
  for (int i = 0; i < 10; ++i) {
    const MappedTag& tag = room_->layout.tags[std::size_t(i)];
    A.row(i) << 1, tag.id % 4, tag.id / 4;
    B.row(i) = tag.T_world_tag.translation().transpose();
  }
  const Eigen::Matrix3d grid =
      Eigen::MatrixXd(A.transpose() * A).llt().solve(Eigen::MatrixXd(A.transpose() * B));
  const double off = std::sqrt((B - A * grid).rowwise().squaredNorm().mean());
  RecordProperty("residual_px", std::to_string(room_->residual_px));
  RecordProperty("off_grid_mm", std::to_string(1e3 * off));
  EXPECT_LT(off, 2.5e-3) << "m, RMS: glued by hand";
  EXPECT_NEAR(std::abs(grid.row(1).normalized().dot(grid.row(2).normalized())), 0, 0.02);
}

TEST_F(RecordedBoard, HeadIsTrackedInAllFrames) {
  HeadTracker tracker(rig(), room_->layout);
  double squares = 0;
  for (std::size_t k = 0; k < kFrames; ++k) {
    tracker.add(HeadPicture{0, atFrame(int(k)), (*pictures_)[k].tags});
    ASSERT_EQ(tracker.last().state, HeadState::tracking) << k;
    squares += std::pow(tracker.last().residual_px, 2) / kFrames;
  }
  RecordProperty("residual_px", std::to_string(std::sqrt(squares)));
  EXPECT_LT(std::sqrt(squares), 0.3);
  EXPECT_TRUE(tracker.problems().empty()) << tracker.problems()[0];
}

TEST_F(RecordedBoard, HidingAThirdOfTheTagsMovesTheOverlayByLittle) {
  HeadTracker whole(rig(), room_->layout), hidden(rig(), room_->layout);
  const EyeCamera eye(rig(), 0);
  std::mt19937 random(5);
  std::vector<double> moves;
  for (std::size_t k = 0; k < kFrames; ++k) {
    HeadPicture picture{0, atFrame(int(k)), (*pictures_)[k].tags};
    whole.add(picture);
    std::shuffle(picture.tags.begin(), picture.tags.end(), random);
    picture.tags.resize(picture.tags.size() - picture.tags.size() / 3);
    hidden.add(picture);
    const auto a = whole.at(picture.time), b = hidden.at(picture.time);
    ASSERT_TRUE(a && b);
    for (const MappedTag& tag : room_->layout.tags) {
      const Vector3d p = tag.T_world_tag.translation();
      moves.push_back(
          (*projectRolling(eye, a->motion, p) - *projectRolling(eye, b->motion, p)).norm());
    }
  }
  std::sort(moves.begin(), moves.end());
  const double p95 = moves[moves.size() * 95 / 100];
  RecordProperty("p95_px", std::to_string(p95));
  EXPECT_LT(p95, 0.5);
}

/// Figures T10 and T11 with real pictures.
TEST_F(RecordedBoard, SwappedAndMovedTagsAreNamed) {
  TagLayout swapped = room_->layout;
  std::swap(swapped.tags[2].T_world_tag, swapped.tags[6].T_world_tag);
  HeadTracker of_swapped(rig(), swapped);
  TagLayout moved = room_->layout;
  moved.tags[3].T_world_tag.translation().x() += 0.01;
  HeadTracker of_moved(rig(), moved);
  for (std::size_t k = 0; k < 10; ++k) {
    const HeadPicture picture{0, atFrame(int(k)), (*pictures_)[k].tags};
    of_swapped.add(picture);
    EXPECT_EQ(of_swapped.last().rejected_ids, (std::vector<int>{2, 6})) << k;
    of_moved.add(picture);
    EXPECT_EQ(of_moved.last().rejected_ids, std::vector<int>{3}) << k;
  }
  EXPECT_TRUE(names(of_swapped, "tags 2 and 6 are swapped in the layout"));
  EXPECT_TRUE(names(of_moved, "tag 3 has moved by 0.01"));
}

TEST_F(RecordedBoard, LoneTagWithAPriorKeepsTheHeadUpright) {
  HeadTracker whole(rig(), room_->layout), lone(rig(), room_->layout);
  std::mt19937 random(6);
  int tracked = 0;
  for (std::size_t k = 0; k < kFrames; ++k) {
    HeadPicture picture{0, atFrame(int(k)), (*pictures_)[k].tags};
    whole.add(picture);
    if (k >= 3) {
      std::shuffle(picture.tags.begin(), picture.tags.end(), random);
      picture.tags.resize(1);
    }
    lone.add(picture);
    const auto a = whole.at(picture.time), b = lone.at(picture.time);
    if (!a || !b || b->state != HeadState::tracking) continue;
    ++tracked;
    EXPECT_LT(difference(a->motion, b->motion).segment<3>(3).norm(), 0.2) << k;
  }
  EXPECT_GT(tracked, 25);
}

TEST(RecordedStereo, ChessboardPairsGiveARig) {
  const auto folder = recorded("mrpt_kfslam");
  if (!folder) GTEST_SKIP() << "no recorded data: mrpt_kfslam";
  const Board board{.columns = 9, .rows = 6, .size_m = 0.03};
  std::vector<BoardSight> left, right;
  int width = 0, height = 0;
  for (int i = 0; i < 4; ++i) {
    for (const char* side : {"left", "right"}) {
      const auto file =
          *folder / "stereo-calib" / (std::to_string(i) + "_" + side + std::string(".jpg"));
      const cv::Mat picture = test::readPicture(file);
      width = picture.cols;
      height = picture.rows;
      const auto sight = findBoard({picture.data, picture.cols, picture.rows, 3}, board);
      ASSERT_TRUE(sight) << file;
      (side[0] == 'l' ? left : right).push_back(*sight);
    }
  }
  const StereoCalibration result = calibrateStereo(left, right, width, height);
  RecordProperty("residual_px", std::to_string(result.residual_px));
  RecordProperty("baseline_squares", std::to_string(result.rig.baseline() / board.size_m));
  EXPECT_LT(result.residual_px, 0.6);
  EXPECT_FALSE(result.left.hints.empty()) << "four pictures are few";
}

}  // namespace
}  // namespace slamscope::tracking
