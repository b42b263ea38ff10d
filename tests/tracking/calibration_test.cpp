// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "tests/tracking/seen_room.hpp"
#include "tracking/board.hpp"
#include "tracking/camera_calibration.hpp"
#include "tracking/head_overlay.hpp"
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

  explicit BoardWalk(int pictures, double tilt = 0.5) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 0.05);
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

std::string complaintOf(const std::vector<BoardSight>& pictures) {
  try {
    (void)calibrateCamera(pictures, 640, 480);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CameraCalibration, RefusesWhatIsTooWeakWithTheReason) {
  EXPECT_NE(complaintOf(BoardWalk(3).left).find("seen in 3 pictures"), std::string::npos);
  EXPECT_NE(complaintOf(BoardWalk(12, 0.02).left).find("held the same way"), std::string::npos);
  std::vector<BoardSight> corner = BoardWalk(12).left;
  for (BoardSight& sight : corner) {
    for (Vector2d& px : sight.px) px = 0.3 * px;
  }
  EXPECT_NE(complaintOf(corner).find("% of the picture"), std::string::npos);
  EXPECT_EQ(complaintOf(BoardWalk(12).left), "");
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
  EXPECT_THROW((void)calibrateRoom(walk.cameras, walk.pictures, options), std::runtime_error);
}

TEST(RoomCalibration, RefusesWalksThatDoNotHangTogether) {
  RoomWalk walk(6);
  const auto complaint = [&](const RoomCalibrationOptions& options) -> std::string {
    try {
      (void)calibrateRoom(walk.cameras, walk.pictures, options);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
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
  const auto file = std::filesystem::temp_directory_path() / "slamscope_rig_test.yaml";
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

/// The derivative by central differences, at rest and in quick motion, and a must-fail twin.
TEST(HeadMotion, JacobiansOfMotionAndPixelAreTheirDifferences) {
  SeenRoom room;
  Rig rig = room.rig;
  rig.cameras[0].readout = std::chrono::milliseconds(20);
  const EyeCamera eye(rig, 0);
  HeadMotion motion;
  motion.T_world_head = room.head(atFrame(10));
  motion.v_world = {0.4, -0.3, 0.1};
  motion.omega_head = {0.2, 1.9, -0.4};
  constexpr double h = 1e-6;
  Matrix12d F;
  HeadJacobian J;
  const Vector3d p(0.3, 0.2, 0.1);
  const HeadMotion later = moved(motion, 0.05, &F);
  ASSERT_TRUE(projectAt(eye, motion, p, 0.007, &J));
  for (int i = 0; i < 12; ++i) {
    const Vector12d step = h * Vector12d::Unit(i);
    const HeadMotion plus = corrected(motion, step), minus = corrected(motion, -step);
    const Vector12d column =
        (difference(later, moved(plus, 0.05)) - difference(later, moved(minus, 0.05))) / (2 * h);
    EXPECT_LT((column - F.col(i)).norm(), 1e-7 * (1 + column.norm())) << i;
    const Vector2d slope =
        (*projectAt(eye, plus, p, 0.007) - *projectAt(eye, minus, p, 0.007)) / (2 * h);
    EXPECT_LT((slope - J.col(i)).norm(), 1e-5 * (1 + slope.norm())) << i;
    if (i < 6) {
      EXPECT_GT((slope + J.col(i)).norm(), 1e-3) << "a flipped sign must be seen";
    }
  }
}

}  // namespace
}  // namespace slamscope::tracking
