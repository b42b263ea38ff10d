// SPDX-License-Identifier: MIT
#include "tests/engine/pair_scene.hpp"

// How much of the device's memory pairs take, and that it stays so.
namespace slamscope::engine {
namespace {

class PairMemory : public PairTest {
 protected:
  static constexpr int kPoints = 200;
  /// Of the filter's covariance: (2 n)² doubles.
  static constexpr double kCovarianceBytes = 8.0 * 4.0 * kPoints * kPoints;

  /// After a frame with this covariance.
  std::size_t deviceBytes(double sigma, const PairChoice& choice = {}) {
    PairGlyphs glyphs = someMap(kPoints, sigma);
    glyphs.choice = choice;
    (void)draw(overFloor(), sceneOf(glyphs), {});
    return stats_.device_bytes;
  }
};

TEST_F(PairMemory, IsWithinTwiceTheCovariancesAndThePictures) {
  (void)draw(overFloor(), {}, {});
  const std::size_t without = stats_.device_bytes;
  // Two entries of eight bytes a pixel, where each of the nearest is kept.
  const double entries = 16.0 * kFloorCamera.width * kFloorCamera.height;
  const double pairs = static_cast<double>(deviceBytes(0.01) - without);
  EXPECT_TRUE(stats_.pairs.splatted);
  EXPECT_LE(pairs, 2.0 * kCovarianceBytes + entries);
  EXPECT_GT(pairs, 0.25 * kCovarianceBytes + entries) << "twin: less than what is uploaded";
  // Ranking by growth remembers two numbers a pair, in two places.
  const std::size_t ranked = deviceBytes(0.011, {.most = 9, .most_by = MostBy::growth});
  EXPECT_LE(static_cast<double>(ranked - without), 2.0 * kCovarianceBytes + entries);
}

TEST_F(PairMemory, ReadInPlaceOrByWayOfABufferPicturesAreTheSame) {
  const View left = overFloor();
  View right = left;
  right.T_eye_scene.pretranslate(Eigen::Vector3d(-0.064, 0.0, 0.0));
  const Scene scene = sceneOf(someMap(20, 0.04));
  const auto in_place = draw(std::array{left, right}, scene, {});
  const std::size_t bytes = stats_.device_bytes;
  useGpu(GpuOptions{.validation = true, .read_in_place = false});
  const auto by_buffer = draw(std::array{left, right}, scene, {});
  EXPECT_TRUE(sameBytes(in_place[0], by_buffer[0]));
  EXPECT_TRUE(sameBytes(in_place[1], by_buffer[1]));
  EXPECT_FALSE(sameBytes(in_place[0], by_buffer[1]));
  if (gpu_->device().type == "cpu") {
    EXPECT_GT(stats_.device_bytes, bytes) << "no buffer was used";
  }
}

TEST_F(PairMemory, DoesNotGrowWithTheFrames) {
  const PairChoice choice{.most = 500, .most_by = MostBy::last_growth};
  (void)deviceBytes(0.010, choice);
  const std::size_t early = deviceBytes(0.011, choice);
  for (int frame = 0; frame < 20; ++frame) {
    EXPECT_EQ(deviceBytes(0.010 + 0.0001 * frame, choice), early) << frame;
  }
  // Twin: another view's pictures are more.
  Offscreen another(gpu_, 64, 64);
  const View view = lookingAt({.width = 64, .height = 64, .fx = 60, .fy = 60, .cx = 32, .cy = 32},
                              {0, -1, 1}, {0, 0, 0});
  (void)another.draw({&view, 1}, {});
  EXPECT_GT(another.lastStats().device_bytes, early);
}

}  // namespace
}  // namespace slamscope::engine
