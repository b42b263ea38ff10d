// SPDX-License-Identifier: MIT
// The V4L2 source against a camera that answers as uvcvideo does.
#include "tracking/v4l2_source.hpp"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "tests/v4l2/fake_camera.hpp"
#include "tracking/frame_source.hpp"
#include "tracking/stereo_source.hpp"

namespace slamscope::tracking {
namespace {

using namespace std::chrono_literals;
using testing::FakeCamera, testing::fakeCamera;

constexpr const char* kPath = "/dev/video90";
constexpr const char* kOther = "/dev/video91";

/// Grey of one level, which tells the frames apart.
std::uint8_t levelOf(std::uint32_t sequence) {
  return static_cast<std::uint8_t>(40 + 10 * (sequence % 16));
}

FakeCamera::Bytes greyPicture(std::uint32_t sequence, std::uint32_t format) {
  const std::uint8_t level = levelOf(sequence);
  const std::size_t pixels = 640 * 480;
  if (format == V4L2_PIX_FMT_GREY) return FakeCamera::Bytes(pixels, level);
  if (format == V4L2_PIX_FMT_YUYV) {
    FakeCamera::Bytes bytes(2 * pixels, 128);  // no colour
    for (std::size_t i = 0; i < bytes.size(); i += 2) bytes[i] = level;
    return bytes;
  }
  FakeCamera::Bytes bytes;
  cv::imencode(".jpg", cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(level)), bytes);
  return bytes;
}

class V4l2Camera : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* path : {kPath, kOther}) {
      fakeCamera(path) = {.formats = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_GREY},
                          .controls = {{V4L2_CID_FOCUS_AUTO, 1},
                                       {V4L2_CID_FOCUS_ABSOLUTE, 0},
                                       {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY},
                                       {V4L2_CID_EXPOSURE_ABSOLUTE, 0}},
                          .picture = greyPicture};
    }
  }
  void TearDown() override { testing::unplugFakeCameras(); }

  static V4l2Options options() { return {.width = 640, .height = 480}; }

  /// What is said when the camera is opened, or gives a frame.
  static std::string complaint(const V4l2Options& options) {
    try {
      (void)openV4l2(kPath, options)->next();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(V4l2Camera, EachPixelFormatGivesThePictureThatWasSent) {
  for (const char* format : {"YUYV", "MJPG", "GREY"}) {
    V4l2Options asked = options();
    asked.pixel_format = format;
    fakeCamera(kPath).next_sequence = 5;
    const auto frame = openV4l2(kPath, asked)->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->width, 640);
    EXPECT_EQ(frame->height, 480);
    EXPECT_EQ(frame->sequence, 5U);
    EXPECT_EQ(frame->source, kPath);
    const double stretch = std::string(format) == "YUYV" ? 255.0 / 219.0 : 1.0;  // video levels
    const double offset = std::string(format) == "YUYV" ? 16.0 : 0.0;
    const double expected = stretch * (levelOf(5) - offset);
    EXPECT_NEAR(frame->bgr.front(), expected, 2) << format;
    EXPECT_NEAR(frame->bgr.back(), expected, 2) << format;
  }
}

TEST_F(V4l2Camera, TakesTheFirstFormatThatBothKnow) {
  fakeCamera(kPath).formats = {V4L2_PIX_FMT_MJPEG};
  EXPECT_EQ(complaint(options()), "");
  fakeCamera(kPath).formats = {V4L2_PIX_FMT_NV12};
  EXPECT_EQ(complaint(options()),
            "/dev/video90: has no 640 x 480; it offers 640 x 480 NV12, 640 x 480 NV12, 640 x 480 "
            "NV12");
}

TEST_F(V4l2Camera, ASizeThatItChangesIsAnError) {
  V4l2Options asked = options();
  asked.width = 1280;
  asked.height = 720;
  asked.pixel_format = "YUYV";
  EXPECT_EQ(complaint(asked), "/dev/video90: has no 1280 x 720 YUYV; it offers 640 x 480 YUYV");
}

TEST_F(V4l2Camera, StampsAreOfMidExposureWhicheverEndTheDriverStamps) {
  V4l2Options asked = options();
  asked.exposure = 8ms;
  asked.readout = 20ms;
  fakeCamera(kPath).next_sequence = 3;  // stamped 99.999 ms
  EXPECT_EQ(openV4l2(kPath, asked)->next()->time, 99'999us + 14ms);
  fakeCamera(kPath).next_sequence = 3;
  fakeCamera(kPath).stamps_start = false;
  EXPECT_EQ(openV4l2(kPath, asked)->next()->time, 99'999us - 14ms);
}

TEST_F(V4l2Camera, FocusAndExposureAreFixedOnRequest) {
  V4l2Options asked = options();
  asked.focus = 30;
  asked.exposure = 8ms;
  (void)openV4l2(kPath, asked);
  const auto& controls = fakeCamera(kPath).controls;
  EXPECT_EQ(controls.at(V4L2_CID_FOCUS_AUTO), 0);
  EXPECT_EQ(controls.at(V4L2_CID_FOCUS_ABSOLUTE), 30);
  EXPECT_EQ(controls.at(V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(controls.at(V4L2_CID_EXPOSURE_ABSOLUTE), 80) << "tenths of a millisecond";
  fakeCamera(kPath).controls.erase(V4L2_CID_FOCUS_ABSOLUTE);
  EXPECT_EQ(complaint(asked), "/dev/video90: can't set focus to 30: Invalid argument");
}

TEST_F(V4l2Camera, HandsOutTheNewestOfTheFramesThatWait) {
  fakeCamera(kPath).ready_at_once = 3;
  const auto camera = openV4l2(kPath, options());
  EXPECT_EQ(camera->next()->sequence, 2U);
  EXPECT_EQ(camera->next()->sequence, 5U) << "all buffers are the driver's again";
}

TEST_F(V4l2Camera, PassesOverSomeDamagedFramesButNotAll) {
  fakeCamera(kPath).damaged = 3;
  EXPECT_EQ(openV4l2(kPath, options())->next()->sequence, 3U);
  fakeCamera(kPath).picture = [](auto, auto) { return FakeCamera::Bytes(100, 0); };
  EXPECT_EQ(complaint(options()), "/dev/video90: frames are damaged");
}

TEST_F(V4l2Camera, SaysWhyThereIsNoPicture) {
  fakeCamera(kPath).silent = true;
  EXPECT_EQ(complaint(options()), "/dev/video90: no frame for 2000 ms");
  fakeCamera(kPath).busy = true;
  EXPECT_EQ(complaint(options()),
            "/dev/video90: no buffers (is another program using it?): Device or resource busy");
  fakeCamera(kPath).captures = false;
  EXPECT_EQ(complaint(options()), "/dev/video90: not a capture device");
  fakeCamera(kPath).plugged = false;
  EXPECT_EQ(complaint(options()), "/dev/video90: no such device");
}

TEST_F(V4l2Camera, UnpluggedWhileItStreamsIsSaid) {
  const auto camera = openV4l2(kPath, options());
  (void)camera->next();
  fakeCamera(kPath).plugged = false;
  EXPECT_THROW((void)camera->next(), std::runtime_error);
  fakeCamera(kPath).plugged = true;
  EXPECT_THROW((void)camera->next(), std::runtime_error) << "an old handle does not revive";
  EXPECT_EQ(openV4l2(kPath, options())->next()->source, kPath);
}

TEST_F(V4l2Camera, OneEyeUnpluggedIsAbsentAndOpenedAgainWhenItIsBack) {
  const auto eyes = openStereoSource("/dev/video90,/dev/video91", {.v4l2 = options()});
  ASSERT_TRUE(eyes->live());
  auto pair = eyes->next();
  ASSERT_TRUE(pair && pair->eyes[0] && pair->eyes[1]);
  fakeCamera(kOther).plugged = false;
  pair = eyes->next();
  ASSERT_TRUE(pair && pair->eyes[0]);
  EXPECT_FALSE(pair->eyes[1]);
  ASSERT_EQ(eyes->problems().size(), 1U);
  EXPECT_EQ(eyes->problems()[0], "right camera: /dev/video91: unplugged");
  fakeCamera(kOther).plugged = true;
  bool back = false;
  for (int k = 0; k < 40 && !back; ++k) {
    // The other eye's clock has gone on meanwhile.
    fakeCamera(kOther).next_sequence = fakeCamera(kPath).next_sequence;
    back = eyes->next()->eyes[1].has_value();
  }
  EXPECT_TRUE(back);
  EXPECT_EQ(fakeCamera(kOther).opened, 2);
  EXPECT_EQ(fakeCamera(kPath).opened, 1);
}

}  // namespace
}  // namespace slamscope::tracking
