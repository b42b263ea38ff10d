// SPDX-License-Identifier: MIT
// hmd on two cameras that come through V4L2, one of which is unplugged for a while.
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "apps/lib/view/hmd.hpp"
#include "tests/v4l2/fake_camera.hpp"
#include "tracking/stereo_lab.hpp"

namespace slamscope::apps {
namespace {

using testing::FakeCamera, testing::fakeCamera;

constexpr std::array kPaths{"/dev/video90", "/dev/video91"};

/// Cameras that send what the eyes of a lab see, as JPEG.
void plugIn(const tracking::StereoLab& lab) {
  for (std::size_t eye = 0; eye < kPaths.size(); ++eye) {
    fakeCamera(kPaths[eye]) = {.formats = {V4L2_PIX_FMT_MJPEG},
                               .picture =
                                   [&lab, eye](std::uint32_t sequence, std::uint32_t) {
                                     const tracking::Frame frame = lab.frame(eye, sequence);
                                     FakeCamera::Bytes bytes;
                                     cv::imencode(
                                         ".jpg",
                                         cv::Mat(frame.height, frame.width, CV_8UC3,
                                                 const_cast<std::uint8_t*>(frame.bgr.data())),
                                         bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
                                     return bytes;
                                   },
                               .interval_us = 50'000};
  }
}

TEST(HmdCameras, OneIsUnpluggedAndComesBackWhileTheHeadIsTracked) {
  tracking::StereoLabOptions room = tracking::defaultStereoLab();
  room.room.fps = 20;
  room.head = tracking::standingHead({.sway = 0});  // painted once
  const tracking::StereoLab lab(room);
  plugIn(lab);
  const auto folder = std::filesystem::path(::testing::TempDir()) / "slamscope-hmd-cameras";
  std::filesystem::create_directories(folder);
  tracking::writeRig(room.rig, folder / "rig.yaml");
  tracking::writeTagLayout(*lab.tags(), folder / "tags.yaml");

  HmdOptions options;
  options.view.camera = std::string(kPaths[0]) + "," + kPaths[1];
  options.view.v4l2 = {.width = 640, .height = 480};
  options.view.tags = folder / "tags.yaml";
  options.view.robot = "none";
  options.view.report = folder / "report.json";
  options.rig = folder / "rig.yaml";
  Hmd hmd(options);
  for (int k = 0; k < 50; ++k) {
    fakeCamera(kPaths[1]).plugged = k < 8 || k >= 15;
    if (k >= 8) fakeCamera(kPaths[1]).next_sequence = fakeCamera(kPaths[0]).next_sequence;
    ASSERT_TRUE(hmd.next());
    hmd.draw();
  }
  hmd.finish(Viewer::Ending::user_quit);

  const auto frames = nlohmann::json::parse(std::ifstream(folder / "report.json"))["frames"];
  ASSERT_EQ(frames.size(), 50U);
  int both = 0, said = 0;
  for (const auto& frame : frames) {
    EXPECT_EQ(frame["head"]["state"], "tracking");
    both += frame["right"]["picture"].get<bool>() ? 1 : 0;
    for (const auto& problem : frame["problems"]) {
      said += problem == "right camera: /dev/video91: unplugged" ? 1 : 0;
    }
  }
  EXPECT_TRUE(frames.back()["right"]["picture"]);
  EXPECT_EQ(both + said, 50) << "an eye without a picture is explained";
  EXPECT_GT(said, 20);
  testing::unplugFakeCameras();
}

}  // namespace
}  // namespace slamscope::apps
