// SPDX-License-Identifier: MIT
#include "engine/window/window.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <random>
#include <thread>

#include "engine/render/offscreen.hpp"
#include "tests/engine/virtual_display.hpp"

#include <X11/keysym.h>

namespace slamscope::engine {
namespace {

Image noisyBytes(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image{width, height, {}};
  image.rgba.resize(static_cast<std::size_t>(4) * width * height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    image.rgba[i] = i % 4 == 3 ? 255 : static_cast<std::uint8_t>(random());
  }
  return image;
}

Image plain(int width, int height, std::uint8_t red, std::uint8_t green) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (const std::uint8_t byte : {red, green, std::uint8_t{30}, std::uint8_t{255}}) {
      image.rgba.push_back(byte);
    }
  }
  return image;
}

Rgba bytesAt(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgba[4 * (static_cast<std::size_t>(y) * image.width + x)];
  return {float(p[0]), float(p[1]), float(p[2]), float(p[3])};
}

bool operator==(const Rgba& a, const Rgba& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b;
}

constexpr const char* kTitle = "a test of slamscope";

// Before the others: once started, GLFW stays with its display.
TEST(WindowWithoutDisplay, SaysSoAndWhatToDo) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  EXPECT_FALSE(displayAvailable());
  try {
    (void)windowInstanceExtensions();
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()),
              "a window was asked for but there is no display: set DISPLAY, or use --output");
  }
  setenv("DISPLAY", ":987", 1);
  EXPECT_TRUE(displayAvailable());
  EXPECT_THROW((void)windowInstanceExtensions(), std::runtime_error);  // nobody answers there
  setenv("DISPLAY", "", 1);
  EXPECT_FALSE(displayAvailable());
}

// Every test draws with validation on, and must leave it silent.
class WindowTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!display_.running()) GTEST_SKIP() << "Xvfb is not installed";
    display_.use();
    gpu_ = std::make_shared<Gpu>(GpuOptions{
        .device = {}, .validation = true, .instance_extensions = windowInstanceExtensions()});
  }

  void TearDown() override {
    if (!gpu_) return;
    for (const std::string& message : gpu_->validationMessages()) ADD_FAILURE() << message;
  }

  static auto equals(const Image& picture) {
    return [&picture](const Image& seen) {
      return seen.width == picture.width && seen.rgba == picture.rgba;
    };
  }

  // Presenting is asynchronous: shows until the screen has it (true), or for 10 s in vain (false).
  bool becomes(const auto& show, Window& window, const auto& as_wanted) {
    for (int i = 0; i < 200; ++i) {
      (void)window.poll();
      show();
      const auto seen = display_.screenshot(kTitle);
      if (seen && as_wanted(*seen)) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  bool becomes(Window& window, std::span<const Image> pictures, const auto& as_wanted) {
    return becomes([&] { window.show(pictures); }, window, as_wanted);
  }
  bool becomes(Window& window, const Image& picture) {
    return becomes(window, {&picture, 1}, equals(picture));
  }
  // Events take their way through the server: polls until there are `count` (or 10 s are over).
  static Input pollFor(Window& window, std::size_t count) {
    Input input;
    for (int i = 0; i < 1000 && input.keys.size() + input.clicks.size() < count; ++i) {
      const Input more = window.poll();
      input.keys.insert(input.keys.end(), more.keys.begin(), more.keys.end());
      input.clicks.insert(input.clicks.end(), more.clicks.begin(), more.clicks.end());
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return input;
  }

  VirtualDisplay& display_ = VirtualDisplay::ofThisProcess();
  std::shared_ptr<Gpu> gpu_;
};

TEST_F(WindowTest, ShowsPicturesByteForByte) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  const Image picture = noisyBytes(320, 240, 1);
  EXPECT_TRUE(becomes(window, picture));
  EXPECT_GT(window.framesPerSecond(), 0.0);

  // Twin: the screen is not equal to a picture of which one byte differs.
  Image other = picture;
  other.rgba[4 * 100] ^= 1;
  EXPECT_NE(display_.screenshot(kTitle)->rgba, other.rgba);
}

TEST_F(WindowTest, PicturesOfAnotherShapeStandInTheMiddleOnBlack) {
  Window window(gpu_, {.title = kTitle, .width = 500, .height = 240});
  const Image picture = plain(320, 240, 200, 100);
  EXPECT_TRUE(becomes(window, {&picture, 1}, [](const Image& seen) {
    return bytesAt(seen, 89, 120) == Rgba{0, 0, 0, 0} &&
           bytesAt(seen, 90, 0) == Rgba{200, 100, 30, 0} &&
           bytesAt(seen, 409, 239) == Rgba{200, 100, 30, 0} &&
           bytesAt(seen, 410, 120) == Rgba{0, 0, 0, 0};
  }));
}

TEST_F(WindowTest, TwoPicturesStandSideBySideAndAreScaledToFit) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 120});
  const std::vector<Image> pair = {plain(320, 240, 200, 0), plain(320, 240, 0, 200)};
  EXPECT_TRUE(becomes(window, pair, [](const Image& seen) {
    return bytesAt(seen, 0, 0) == Rgba{200, 0, 30, 0} &&
           bytesAt(seen, 159, 119) == Rgba{200, 0, 30, 0} &&
           bytesAt(seen, 160, 0) == Rgba{0, 200, 30, 0} &&
           bytesAt(seen, 319, 119) == Rgba{0, 200, 30, 0};
  }));
}

Scene someScene() {
  Scene scene;
  Ellipsoid ellipsoid;
  ellipsoid.centre = {0.0, 0.0, 2.0};
  ellipsoid.axes *= 0.4;
  ellipsoid.colour = {0.9F, 0.1F, 0.1F, 0.7F};
  scene.ellipsoids = {ellipsoid};
  scene.texts = {{.position_px = {10, 10}, .text = "mode all · σ", .height_px = 14, .colour = {}}};
  return scene;
}

View someView(int width, int height, double shift) {
  View view;
  view.camera = {.width = width,
                 .height = height,
                 .fx = 300,
                 .fy = 300,
                 .cx = width / 2.0,
                 .cy = height / 2.0};
  view.T_eye_scene.translation().x() = shift;
  return view;
}

TEST_F(WindowTest, ShowsASceneByteForByteAsTheFileHasIt) {
  Window window(gpu_, {.title = kTitle, .width = 640, .height = 240});
  const std::array<View, 2> views = {someView(320, 240, 0.0), someView(320, 240, -0.1)};
  const auto files = Offscreen(gpu_, 320, 240, 2).draw(views, someScene());
  Image expected{640, 240, {}};
  for (int row = 0; row < 240; ++row) {
    for (const Image& file : files) {
      const auto begin = file.rgba.begin() + row * 320 * 4;
      expected.rgba.insert(expected.rgba.end(), begin, begin + 320 * 4);
    }
  }
  EXPECT_NE(files[0].rgba, files[1].rgba);
  EXPECT_TRUE(becomes([&] { window.show(views, someScene()); }, window, equals(expected)));
  EXPECT_EQ(window.lastStats().draws("ellipsoids"), 1);

  // One view again, in the same window: now in its middle.
  EXPECT_TRUE(becomes(
      [&] {
        window.show({&views[0], 1}, someScene());
      },
      window,
      [&](const Image& seen) {
        return seen.width == 640 && bytesAt(seen, 160, 0) == bytesAt(files[0], 0, 0) &&
               bytesAt(seen, 320, 120) == bytesAt(files[0], 160, 120);
      }));
}

TEST_F(WindowTest, FollowsResizingSilently) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  EXPECT_TRUE(becomes(window, noisyBytes(320, 240, 2)));
  for (const auto& [width, height] : {std::pair{400u, 300u}, {160u, 120u}, {401u, 33u}, {1u, 1u}}) {
    display_.resize(kTitle, width, height);
    EXPECT_TRUE(becomes(window, noisyBytes(int(width), int(height), width)));
  }
  window.resize(320, 240);
  EXPECT_TRUE(becomes(window, noisyBytes(320, 240, 3)));
}

TEST_F(WindowTest, ResizingBetweenPollAndShowIsSilentToo) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  const Image picture = noisyBytes(320, 240, 4);
  for (unsigned i = 0; i < 20; ++i) {
    (void)window.poll();
    display_.resize(kTitle, 300 + 3 * i, 200 + 5 * i);
    window.show({&picture, 1});
  }
  display_.resize(kTitle, 320, 240);
  EXPECT_TRUE(becomes(window, picture));
}

TEST_F(WindowTest, ShowsNothingWhileMinimisedAndComesBack) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  EXPECT_TRUE(becomes(window, noisyBytes(320, 240, 5)));
  display_.setMinimised(kTitle, true);
  const Image picture = noisyBytes(320, 240, 6);
  for (int i = 0; i < 10; ++i) {
    (void)window.poll();
    window.show({&picture, 1});
    EXPECT_FALSE(display_.screenshot(kTitle));
  }
  EXPECT_TRUE(window.open());
  display_.setMinimised(kTitle, false);
  EXPECT_TRUE(becomes(window, picture));
}

TEST_F(WindowTest, SurvivesTheLossOfSurfaceAndSwapchain) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240, .low_latency = true});
  for (unsigned i = 0; i < 5; ++i) {
    const Image picture = noisyBytes(320, 240, 10 + i);
    window.show({&picture, 1});
    window.rebuild();
    EXPECT_TRUE(becomes(window, picture));
  }
}

TEST_F(WindowTest, PicturesOfChangingSizeFollowEachOther) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  for (const int width : {64, 640, 320}) {
    const Image picture = noisyBytes(width, width * 3 / 4, 20);
    (void)window.poll();
    window.show({&picture, 1});
  }
  EXPECT_TRUE(becomes(window, noisyBytes(320, 240, 21)));
  EXPECT_THROW(window.show(std::span<const Image>{}), std::invalid_argument);
  Image broken = noisyBytes(320, 240, 22);
  broken.rgba.pop_back();
  EXPECT_THROW(window.show({&broken, 1}), std::invalid_argument);
  EXPECT_TRUE(becomes(window, noisyBytes(320, 240, 23)));
}

TEST_F(WindowTest, KeysComeAsTyped) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  EXPECT_TRUE(becomes(window, noisyBytes(320, 240, 7)));
  display_.pressKey(kTitle, XK_m);
  display_.pressKey(kTitle, XK_m, true);
  display_.pressKey(kTitle, XK_space);
  display_.pressKey(kTitle, XK_Right, true);
  display_.pressKey(kTitle, XK_Escape);
  const auto keys = pollFor(window, 5).keys;
  ASSERT_EQ(keys.size(), 5u);
  EXPECT_EQ(keys[0].character, U'm');
  EXPECT_EQ(keys[1].character, U'M');
  EXPECT_EQ(keys[2].character, U' ');
  EXPECT_EQ(keys[3].key, Key::right);
  EXPECT_TRUE(keys[3].shift);
  EXPECT_EQ(keys[4].key, Key::escape);
  EXPECT_TRUE(window.poll().keys.empty());
}

TEST_F(WindowTest, ClicksComeInPixelsOfThePicture) {
  Window window(gpu_, {.title = kTitle, .width = 500, .height = 240});
  EXPECT_TRUE(becomes(window, noisyBytes(500, 240, 8)));
  const Image picture = noisyBytes(320, 240, 8);
  window.show({&picture, 1});
  display_.click(kTitle, 90 + 25, 60);
  const auto clicks = pollFor(window, 1).clicks;
  ASSERT_EQ(clicks.size(), 1u);
  EXPECT_EQ(clicks[0].view, 0);
  EXPECT_EQ(clicks[0].button, 0);
  EXPECT_EQ(clicks[0].picture_px,
            Eigen::Vector2d(24.5, 59.5));  // a corner of the pixel, in OpenCV's
  display_.click(kTitle, 10, 60);          // in the border
  EXPECT_TRUE(window.poll().clicks.empty());
}

TEST_F(WindowTest, ClosesWhenAsked) {
  Window window(gpu_, {.title = kTitle, .width = 320, .height = 240});
  EXPECT_TRUE(window.open());
  display_.askToClose(kTitle);
  for (int i = 0; i < 1000 && window.open(); ++i) {
    (void)window.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(window.open());
}

TEST_F(WindowTest, OpensTwiceAndFullScreen) {
  { Window first(gpu_, {.title = kTitle, .width = 320, .height = 240}); }
  Window second(gpu_, {.title = kTitle, .full_screen = true});
  EXPECT_TRUE(becomes(second, noisyBytes(800, 600, 9)));
}

TEST_F(WindowTest, MonitorThatIsNotThereIsNamed) {
  try {
    Window window(gpu_, {.title = kTitle, .monitor = 3, .full_screen = true});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "monitor 3 was asked for, but there is one (0)");
  }
}

TEST_F(WindowTest, GpuThatWasMadeForFilesIsRefused) {
  const auto for_files = std::make_shared<Gpu>();
  EXPECT_THROW(Window(for_files, {.title = kTitle}), std::runtime_error);
}

}  // namespace
}  // namespace slamscope::engine
