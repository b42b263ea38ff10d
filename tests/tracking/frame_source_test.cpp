// SPDX-License-Identifier: MIT
#include "tracking/frame_source.hpp"

#include <filesystem>
#include <fstream>
#include <functional>

#include "tracking/stamps.hpp"

namespace slamscope::tracking {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// A directory for one test, gone after it.
class FrameSources : public ::testing::Test {
 protected:
  FrameSources() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    directory_ = fs::path(::testing::TempDir()) / (std::string("slamscope_frames_") + test->name());
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  ~FrameSources() override { fs::remove_all(directory_); }

  /// A picture of one grey value.
  void writePicture(const std::string& name, int value, int width = 8, int height = 6) const {
    std::ofstream out(directory_ / name, std::ios::binary);
    out << "P6\n"
        << width << ' ' << height << "\n255\n"
        << std::string(3 * width * height, static_cast<char>(value));
  }
  void writeText(const std::string& name, const std::string& text) const {
    std::ofstream(directory_ / name) << text;
  }
  [[nodiscard]] std::string at(const std::string& name) const {
    return (directory_ / name).string();
  }

  fs::path directory_;
};

/// Grey value of the next frame, −1 at the end.
int nextValue(FrameSource& source) {
  const std::optional<Frame> frame = source.next();
  return frame ? frame->bgr.at(0) : -1;
}

std::string errorOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

/// One line, and it holds every word.
void expectSays(const std::string& message, const std::vector<std::string>& words) {
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
}

TEST_F(FrameSources, DirectoryComesInNaturalOrder) {
  writePicture("img10.ppm", 10);
  writePicture("img9.ppm", 9);
  writePicture("img1.ppm", 1);
  writeText("notes.txt", "no picture");
  const auto source = openFrameSource(directory_.string());
  EXPECT_EQ(source->count(), 3U);
  EXPECT_FALSE(source->stamped());
  const Frame first = *source->next();
  EXPECT_EQ(first.bgr, std::vector<std::uint8_t>(8 * 6 * 3, 1));
  EXPECT_EQ(first.width, 8);
  EXPECT_EQ(first.time, 0ns);
  EXPECT_EQ(nextValue(*source), 9);
  const Frame last = *source->next();
  EXPECT_EQ(last.bgr[0], 10);
  EXPECT_EQ(last.sequence, 2U);
  EXPECT_EQ(last.time, std::chrono::nanoseconds(66666667))
      << "30 frames a second where nothing is said";
  EXPECT_FALSE(source->next());
}

TEST_F(FrameSources, StampsNameTheFramesAndTheirTimes) {
  writePicture("a.ppm", 1);
  writePicture("b.ppm", 2);
  writePicture("c.ppm", 3);
  writeText("stamps.csv", "file,time_s\nb.ppm,100.25\n\n# later\na.ppm , 100.3\n");
  const auto source = openFrameSource(directory_.string());
  EXPECT_TRUE(source->stamped());
  EXPECT_EQ(source->count(), 2U);
  const Frame first = *source->next();
  EXPECT_EQ(first.bgr[0], 2);
  EXPECT_EQ(first.time, 100250ms);
  EXPECT_EQ(source->next()->time, 100300ms);

  const auto at_rate = openFrameSource(directory_.string(), {.fps = 10});
  EXPECT_FALSE(at_rate->stamped());
  EXPECT_EQ(at_rate->count(), 3U);
  (void)at_rate->next();
  EXPECT_EQ(at_rate->next()->time, 100ms);
}

TEST_F(FrameSources, PatternTakesItsNumbersOnly) {
  writePicture("img-00012.ppm", 12);
  writePicture("img-00002.ppm", 2);
  writePicture("img-7.ppm", 7);
  writePicture("other-00003.ppm", 3);
  const auto source = openFrameSource(at("img-%05d.ppm"));
  EXPECT_EQ(nextValue(*source), 2);
  EXPECT_EQ(nextValue(*source), 12);
  EXPECT_EQ(nextValue(*source), -1);
  EXPECT_EQ(openFrameSource(at("img-%d.ppm"))->count(), 3U);
  expectSays(errorOf([&] { (void)openFrameSource(at("none-%d.ppm")); }),
             {"none-%d.ppm", "no picture"});
  expectSays(errorOf([&] { (void)openFrameSource(at("img-%s.ppm")); }),
             {"img-%s.ppm", "frame-%05d.png"});
}

TEST_F(FrameSources, OneImageIsOneFrame) {
  writePicture("still.ppm", 77);
  const auto source = openFrameSource(at("still.ppm"));
  EXPECT_EQ(nextValue(*source), 77);
  EXPECT_EQ(nextValue(*source), -1);
}

/// An uncompressed video of flat grey frames, 25 a second.
void writeVideo(const fs::path& file, int frames) {
  std::ofstream out(file, std::ios::binary);
  out << "YUV4MPEG2 W16 H16 F25:1 Ip A1:1 C444\n";
  for (int k = 0; k < frames; ++k)
    out << "FRAME\n"
        << std::string(256, static_cast<char>(60 + 20 * k))
        << std::string(512, static_cast<char>(128));
}

TEST_F(FrameSources, VideoKeepsItsOwnClock) {
  writeVideo(directory_ / "v.y4m", 4);
  const auto source = openFrameSource(at("v.y4m"));
  EXPECT_TRUE(source->stamped());
  int previous = -1;
  for (int k = 0; k < 4; ++k) {
    const std::optional<Frame> frame = source->next();
    ASSERT_TRUE(frame) << k;
    EXPECT_EQ(frame->time, k * 40ms);
    EXPECT_EQ(frame->sequence, static_cast<std::uint64_t>(k));
    EXPECT_GT(frame->bgr[0], previous);
    previous = frame->bgr[0];
  }
  EXPECT_FALSE(source->next());

  const auto at_rate = openFrameSource(at("v.y4m"), {.fps = 10});
  EXPECT_FALSE(at_rate->stamped());
  (void)at_rate->next();
  EXPECT_EQ(at_rate->next()->time, 100ms);
}

TEST_F(FrameSources, SayWhatIsWrongInOneLine) {
  expectSays(errorOf([&] { (void)openFrameSource(at("missing.mp4")); }),
             {"missing.mp4", "no such file"});
  expectSays(errorOf([&] { (void)openFrameSource(at("missing")); }), {"missing", "no such file"});
  expectSays(errorOf([&] { (void)openFrameSource(directory_.string()); }),
             {directory_.string(), "no picture"});
  writeText("text.mp4", "this is no video");
  expectSays(errorOf([&] { (void)openFrameSource(at("text.mp4")); }), {"text.mp4", "video"});

  writePicture("1.ppm", 1);
  writePicture("2.ppm", 2, 9, 6);
  writeText("3.png", "this is no picture");
  const auto source = openFrameSource(directory_.string());
  (void)source->next();
  expectSays(errorOf([&] { (void)source->next(); }), {"2.ppm", "9 x 6", "8 x 6"});
  expectSays(errorOf([&] { (void)openFrameSource(at("3.png"))->next(); }), {"3.png", "picture"});
}

TEST_F(FrameSources, BadStampsAreNamedWithTheirLine) {
  writePicture("a.ppm", 1);
  const auto error = [&](const std::string& text) {
    writeText("stamps.csv", text);
    return errorOf([&] { (void)openFrameSource(directory_.string()); });
  };
  expectSays(error("a.ppm,1\n"), {"stamps.csv, line 1", "file,time_s"});
  expectSays(error("file,time_s\na.ppm,soon\n"), {"line 2", "'soon'", "number"});
  expectSays(error("file,time_s\na.ppm\n"), {"line 2", "number"});
  expectSays(error("file,time_s\na.ppm,nan\n"), {"line 2", "number"});
  expectSays(error("file,time_s\na.ppm,2\nb.ppm,1\n"), {"line 3", "not after"});
  expectSays(error("file,time_s\na.ppm,1\na.ppm,2\n"), {"line 3", "already"});
  expectSays(error("file,time_s\n"), {"no stamp"});
  expectSays(error("file,time_s\ngone.ppm,1\n"), {"gone.ppm", "not there"});
  EXPECT_EQ(error("file,time_s\na.ppm,1\n"), "no error");
}

TEST(Stamps, NaturalOrderReadsNumbersAsNumbers) {
  EXPECT_TRUE(naturalLess("f9", "f10"));
  EXPECT_FALSE(naturalLess("f10", "f9"));
  EXPECT_TRUE(naturalLess("f2b1", "f2b02"));
  EXPECT_TRUE(naturalLess("f", "f1"));
  EXPECT_TRUE(naturalLess("a10", "b9"));
  EXPECT_FALSE(naturalLess("f7", "f7"));
}

TEST(V4l2, SaysWhatIsNoCamera) {
  expectSays(errorOf([] { (void)openFrameSource("/dev/video4711"); }),
             {"/dev/video4711", "no such device"});
  expectSays(errorOf([] { (void)openFrameSource("4711"); }), {"/dev/video4711", "no such device"});
  expectSays(errorOf([] { (void)openFrameSource("/dev/null"); }),
             {"/dev/null", "not a capture device"});
}

TEST(V4l2, StampsAreMovedToMidExposure) {
  EXPECT_EQ(midExposure(100ms, StampPoint::start_of_exposure, 8ms, 20ms), 114ms);
  EXPECT_EQ(midExposure(100ms, StampPoint::end_of_frame, 8ms, 20ms), 86ms);
}

}  // namespace
}  // namespace slamscope::tracking
