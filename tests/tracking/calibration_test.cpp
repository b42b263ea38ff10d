// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tests/tracking/seen_room.hpp"
#include "tracking/board.hpp"
#include "tracking/camera_calibration.hpp"
#include "tracking/room_calibration.hpp"
#include "tracking/sheet.hpp"

namespace slamscope::tracking {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Vector2d, Eigen::Vector3d;
using testing::atFrame, testing::SeenRoom;

TEST(Sheet, TagsAreTrueToScaleAndAsLibapriltagHasThem) {
  const std::string pdf = sheetPdf({.first_id = 3, .count = 1, .size_mm = 80});
  // An A4 page, and the black square's upper edge: 80 mm wide, one eighth of it high.
  EXPECT_NE(pdf.find("/MediaBox [0 0 595.2756 841.8898]"), std::string::npos);
  EXPECT_NE(pdf.find("226.7717 28.3465 re f"), std::string::npos);
  EXPECT_NE(pdf.find("(36h11  id 3  80 mm)"), std::string::npos);
  EXPECT_NE(sheetPdf({.count = 30, .size_mm = 80}).find("/Count 15"), std::string::npos)
      << "two a page";
}

TEST(Sheet, RefusesWhatDoesNotFit) {
  EXPECT_THROW((void)sheetPdf({.size_mm = 200}), std::invalid_argument);
  EXPECT_THROW((void)sheetPdf({.first_id = 580, .count = 20}), std::invalid_argument);
  EXPECT_THROW((void)sheetPdf({.kind = SheetKind::chessboard, .size_mm = 40}),
               std::invalid_argument);
  EXPECT_NO_THROW((void)sheetPdf({.kind = SheetKind::april_grid, .size_mm = 20}));
}

/// A chessboard in front of two cameras, seen with noise.
struct BoardWalk {
  Rig rig = defaultLabRig();
  std::vector<BoardSight> left, right;

  explicit BoardWalk(int pictures, double tilt = 0.5, double noise_px = 0.05) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, noise_px);
    std::uniform_real_distribution<double> any(-1, 1);
    while (static_cast<int>(left.size()) < pictures) {
      const Isometry3d T_head_board =
          Eigen::Translation3d(0.25 * any(random) - 0.1, 0.18 * any(random) - 0.08,
                               0.55 + 0.15 * any(random)) *
          AngleAxisd(tilt * any(random), Vector3d::UnitX()) *
          AngleAxisd(tilt * any(random), Vector3d::UnitY());
      std::array<BoardSight, 2> sights;
      bool inside = true;
      for (std::size_t camera = 0; camera < 2; ++camera) {
        for (int i = 0; i < 48; ++i) {
          const Vector3d p(0.03 * (i % 8), 0.03 * (i / 8), 0);
          const auto px =
              lab::projectByOpenCv(rig.cameras[camera].info,
                                   {rig.T_head_camera(camera).inverse() * (T_head_board * p)})[0];
          inside = inside && px.x() > 0 && px.y() > 0 && px.x() < 639 && px.y() < 479;
          sights[camera].p_board.push_back(p);
          sights[camera].px.emplace_back(px + Vector2d(noise(random), noise(random)));
        }
      }
      if (!inside) continue;
      left.push_back(sights[0]);
      right.push_back(sights[1]);
    }
  }
};

TEST(CameraCalibration, FindsTheCamerasAndHowTheyStandToEachOther) {
  const BoardWalk walk(20);
  const StereoCalibration result = calibrateStereo(walk.left, walk.right, 640, 480);
  EXPECT_NEAR(result.left.info.K(0, 0), walk.rig.cameras[0].info.K(0, 0), 1.5);
  EXPECT_NEAR(result.right.info.K(0, 2), walk.rig.cameras[1].info.K(0, 2), 1.5);
  EXPECT_NEAR(result.residual_px, 0.07, 0.02) << "0.05 px on each axis";
  const Isometry3d off = result.rig.T_right_left.inverse() * walk.rig.T_right_left;
  EXPECT_LT(off.translation().norm(), 5e-4);
  EXPECT_LT(AngleAxisd(off.linear()).angle(), 2e-3);
  EXPECT_LT(result.left.sigma_focal_px, 1.0);
}

/// What a calibration is refused with; empty where it isn't.
template <typename Calibrate>
std::string refusalOf(const Calibrate& calibrate) {
  try {
    calibrate();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string complaintOf(const std::vector<BoardSight>& pictures) {
  return refusalOf([&] { (void)calibrateCamera(pictures, 640, 480); });
}

TEST(CameraCalibration, RefusesWhatIsTooWeakWithTheReason) {
  EXPECT_NE(complaintOf(BoardWalk(3).left).find("seen in 3 pictures"), std::string::npos);
  EXPECT_NE(complaintOf(BoardWalk(12, 0.02).left).find("held the same way"), std::string::npos);
  std::vector<BoardSight> corner = BoardWalk(12).left;
  for (BoardSight& sight : corner) {
    for (Vector2d& px : sight.px) px = 0.3 * px;
  }
  EXPECT_NE(complaintOf(corner).find("% of the picture"), std::string::npos);
  EXPECT_NE(complaintOf(BoardWalk(4, 0.25, 3.0).left).find("focal length is known to"),
            std::string::npos);
  EXPECT_EQ(complaintOf(BoardWalk(12).left), "");
}

TEST(CameraCalibration, HintsAtWhatWouldMakeItBetter) {
  const auto hintsOf = [](const std::vector<BoardSight>& pictures) {
    std::string all;
    for (const std::string& hint : calibrateCamera(pictures, 640, 480).hints) all += hint + "\n";
    return all;
  };
  EXPECT_NE(hintsOf(BoardWalk(6).left).find("6 pictures; ten and more are better"),
            std::string::npos);
  BoardWalk walk(20);
  EXPECT_EQ(hintsOf(walk.left), "");
  for (Vector2d& px : walk.left[7].px) px += Vector2d(std::sin(px.y()), std::sin(3 * px.x()));
  EXPECT_NE(hintsOf(walk.left).find("picture 7 fits worst"), std::string::npos);
}

TEST(CameraCalibration, StereoRefusesWithTheCameraThatIsToBlame) {
  const BoardWalk walk(12);
  const auto stereo = [](const std::vector<BoardSight>& left,
                         const std::vector<BoardSight>& right) {
    return refusalOf([&] { (void)calibrateStereo(left, right, 640, 480); });
  };
  EXPECT_EQ(stereo(walk.left, walk.right), "");
  std::vector<BoardSight> fewer = walk.right;
  fewer.pop_back();
  EXPECT_EQ(stereo(walk.left, fewer), "12 pictures of the left camera, 11 of the right");
  std::vector<BoardSight> corner = walk.right;
  for (BoardSight& sight : corner) {
    for (Vector2d& px : sight.px) px *= 0.3;
  }
  EXPECT_EQ(stereo(walk.left, corner).find("right camera: the board's points lie in"), 0U);
}

/// A walk around the room, both eyes.
std::vector<RoomPicture> walkThrough(SeenRoom& room, int pictures) {
  std::vector<RoomPicture> walk;
  for (int k = 0; k < pictures; ++k) {
    for (const HeadPicture& picture : room.pair(atFrame(12 * k))) {
      walk.push_back({picture.camera, picture.tags});
    }
  }
  return walk;
}

struct RoomWalk {
  SeenRoom room;
  std::vector<CameraModel> cameras;
  std::vector<RoomPicture> pictures;

  explicit RoomWalk(int count = 64) {
    for (const RigCamera& camera : room.rig.cameras) cameras.emplace_back(camera.info);
    pictures = walkThrough(room, count);
  }
};

TEST(RoomCalibration, FindsTheRoomFromAWalk) {
  RoomWalk walk;
  RoomCalibrationOptions options;
  options.size_m = 0.30;
  for (int id = 100; id < 108; ++id) options.sizes[id] = 0.20;
  options.floor = {100, 101, 102, 103, 104, 105, 106, 107, 108, 109, 110, 111};
  options.gauge = 100;
  const RoomCalibration result = calibrateRoom(walk.cameras, walk.pictures, options);
  EXPECT_LT(result.residual_px, 0.08);
  EXPECT_LT(result.floor_m, 5e-4);
  // The world is the gauge's: bring it to where the truth has it.
  const MappedTag* gauge = result.layout.find(100);
  ASSERT_TRUE(gauge);
  const Isometry3d T_true_found =
      walk.room.truth.find(100)->T_world_tag * gauge->T_world_tag.inverse();
  double worst = 0;
  for (const MappedTag& tag : result.layout.tags) {
    const Isometry3d off =
        walk.room.truth.find(tag.id)->T_world_tag.inverse() * T_true_found * tag.T_world_tag;
    worst = std::max(worst, off.translation().norm());
  }
  EXPECT_GE(result.layout.tags.size(), 20U);
  EXPECT_LT(worst, 0.008) << "over six metres";
}

TEST(RoomCalibration, RefusesSizesThatContradictThePictures) {
  RoomWalk walk(24);
  RoomCalibrationOptions options;
  options.size_m = 0.30;  // the small ones of the floor aren't
  const std::string said =
      refusalOf([&] { (void)calibrateRoom(walk.cameras, walk.pictures, options); });
  EXPECT_NE(said.find("than stated, or moved"), std::string::npos) << said;
}

TEST(RoomCalibration, RefusesTagsThatMoveAndCamerasThatAreWrong) {
  RoomWalk walk(24);
  RoomCalibrationOptions options;
  options.size_m = 0.30;
  for (int id = 100; id < 108; ++id) options.sizes[id] = 0.20;
  const auto refusal = [&](const RoomWalk& given) {
    return refusalOf([&] { (void)calibrateRoom(given.cameras, given.pictures, options); });
  };
  EXPECT_EQ(refusal(walk), "");
  options.floor = {100, 499};
  EXPECT_EQ(refusal(walk), "tags: floor tag 499 is never seen");
  options.floor.clear();

  RoomWalk moving = walk;  // tag 101, kicked to and fro
  MappedTag& kicked = *std::find_if(moving.room.truth.tags.begin(), moving.room.truth.tags.end(),
                                    [](const MappedTag& tag) { return tag.id == 101; });
  kicked.T_world_tag.translation().x() += 0.2;
  const std::vector<RoomPicture> elsewhere = walkThrough(moving.room, 24);
  for (std::size_t i = 0; i < elsewhere.size(); i += 4) moving.pictures[i] = elsewhere[i];
  for (std::size_t i = 1; i < elsewhere.size(); i += 4) moving.pictures[i] = elsewhere[i];
  EXPECT_NE(refusal(moving).find("tags: 101"), std::string::npos) << refusal(moving);

  RoomWalk zoomed = walk;
  CameraInfo wrong = zoomed.room.rig.cameras[0].info;
  wrong.K.topLeftCorner<2, 2>() *= 1.3;
  for (CameraModel& camera : zoomed.cameras) camera = CameraModel(wrong);
  EXPECT_NE(refusal(zoomed).find("contradict"), std::string::npos) << refusal(zoomed);
}

TEST(RoomCalibration, RefusesWalksThatDoNotHangTogether) {
  RoomWalk walk(6);
  const auto complaint = [&](const RoomCalibrationOptions& options) {
    return refusalOf([&] { (void)calibrateRoom(walk.cameras, walk.pictures, options); });
  };
  EXPECT_NE(complaint({.gauge = 77}).find("in 0 pictures"), std::string::npos) << "no size";
  EXPECT_NE(complaint({.size_m = 0.3, .gauge = 77}).find("gauge tag 77"), std::string::npos);
  TagDetection lonely = walk.pictures[0].tags[0];
  lonely.id = 300;
  walk.pictures.push_back({0, {lonely}});
  EXPECT_NE(complaint({.size_m = 0.3}).find("300 is never seen beside the others"),
            std::string::npos);
}

TEST(RigFile, ComesBackAsItWasWritten) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("slamscope_rig" + std::to_string(::getpid()) + ".yaml");
  Rig rig = defaultLabRig();
  rig.cameras[1].readout = std::chrono::microseconds(20500);
  rig.cameras[1].time_offset = std::chrono::microseconds(-3500);
  rig.cameras[0].display = {
      .centre = {0.48, 0.5}, .k = {0.2, 0.1, 0}, .zoom = 1.1, .colour_scale = {0.99, 1, 1.01}};
  writeRig(rig, file);
  const Rig back = readRig(file);
  std::filesystem::remove(file);
  ASSERT_EQ(back.cameras.size(), 2U);
  EXPECT_EQ(back.T_right_left.matrix(), rig.T_right_left.matrix());
  EXPECT_EQ(back.T_head_left.matrix(), rig.T_head_left.matrix());
  for (int i = 0; i < 2; ++i) {
    const RigCamera &a = rig.cameras[i], &b = back.cameras[i];
    EXPECT_EQ(a.info.K, b.info.K);
    EXPECT_EQ(a.info.D, b.info.D);
    EXPECT_EQ(a.readout, b.readout);
    EXPECT_EQ(a.time_offset, b.time_offset);
    EXPECT_EQ(a.display, b.display);
  }
}

TEST(DisplayLens, PlainOneShowsThePictureAsItIsAndABarrelPullsInFromFurtherOut) {
  const Vector2d px(600, 100);
  EXPECT_EQ(shownAt({}, px, 640, 480, 1), px);
  DisplayLens lens;
  lens.k = {0.2, 0, 0};
  const Vector2d axis(319.5, 239.5);
  EXPECT_LT((shownAt(lens, axis, 640, 480, 1) - axis).norm(), 1e-12);
  EXPECT_GT((shownAt(lens, px, 640, 480, 1) - axis).norm(), (px - axis).norm());
  lens.colour_scale = {1, 1, 1.02};
  EXPECT_GT((shownAt(lens, px, 640, 480, 2) - axis).norm(),
            (shownAt(lens, px, 640, 480, 1) - axis).norm());
}

}  // namespace
}  // namespace slamscope::tracking
