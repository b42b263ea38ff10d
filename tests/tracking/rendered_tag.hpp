// SPDX-License-Identifier: MIT
#pragma once

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <vector>

namespace slamscope::tracking::testing {

/// A grey picture, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;
};

/// Pixels of a printed 36h11 tag (10 × 10 cells, the white rim included), as libapriltag prints it.
class PrintedTag {
 public:
  explicit PrintedTag(int id) {
    apriltag_family_t* family = tag36h11_create();
    image_u8_t* image = apriltag_to_image(family, id);
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 10; ++x) cells_[y][x] = image->buf[y * image->stride + x] > 127;
    }
    std::free(image->buf);  // image_u8_destroy lives in another library
    std::free(image);
    tag36h11_destroy(family);
  }

  /// Mean reflectance (0 black, 1 white, `around` outside of the paper) of a rectangle about a
  /// point of the tag's plane: black square from −1 to 1, x to the right, y up.
  [[nodiscard]] double mean(double x, double y, double width, double height, double around) const {
    const double cells_x = (x + 1) * 4 + 1,
                 cells_y = (1 - y) * 4 + 1;  // from the paper's upper left
    const double half_x = std::clamp(width * 2, 1e-9, 0.5),
                 half_y = std::clamp(height * 2, 1e-9, 0.5);
    double sum = 0;
    for (int row = int(std::floor(cells_y - half_y)); row <= int(std::floor(cells_y + half_y));
         ++row) {
      const double share_y = overlap(row, cells_y, half_y);
      for (int col = int(std::floor(cells_x - half_x)); col <= int(std::floor(cells_x + half_x));
           ++col) {
        const bool paper = row >= 0 && row < 10 && col >= 0 && col < 10;
        const double value = paper ? (cells_[row][col] ? 1.0 : 0.0) : around;
        sum += value * share_y * overlap(col, cells_x, half_x);
      }
    }
    return sum;
  }

 private:
  static double overlap(int cell, double centre, double half) {
    const double low = std::max(double(cell), centre - half),
                 high = std::min(cell + 1.0, centre + half);
    return std::max(0.0, high - low) / (2 * half);
  }
  bool cells_[10][10];
};

struct Rendering {
  int width = 200, height = 200;
  double blur_px = 0.5;  ///< standard deviation
  double noise = 2;      ///< grey levels
  double black = 30, white = 220, around = 0.6;
  unsigned seed = 1;
  /// Place on the tag's plane (black square −1 … 1) of a point of the picture (OpenCV's
  /// convention).
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> tag_of_pixel;
};

/// The tag as a linear sensor with square pixels behind a Gaussian blur sees it: areas integrated,
/// not sampled, so that corners are where they should be to about 0.001 px.
inline Picture render(const PrintedTag& tag, const Rendering& r) {
  constexpr int kParts = 5;  // of a pixel, each way
  const int pad = int(std::ceil(4 * r.blur_px)) + 1;
  const int columns = (r.width + 2 * pad) * kParts, rows = (r.height + 2 * pad) * kParts;
  const auto place = [&](int part) { return (part + 0.5) / kParts - 0.5 - pad; };
  std::vector<float> fine(std::size_t(columns) * rows);
  for (int y = 0; y < rows; ++y) {
    Eigen::Vector2d left = r.tag_of_pixel({place(-1), place(y)});
    for (int x = 0; x < columns; ++x) {
      const Eigen::Vector2d q = r.tag_of_pixel({place(x), place(y)});
      const Eigen::Vector2d right = q - left;
      left = q;
      float& value = fine[std::size_t(y) * columns + x];
      value = float(r.around);
      if (q.cwiseAbs().maxCoeff() > 1.4) continue;  // beyond the paper
      const Eigen::Vector2d down = r.tag_of_pixel({place(x), place(y + 1)}) - q;
      value = float(tag.mean(q.x(), q.y(), std::hypot(right.x(), down.x()),
                             std::hypot(right.y(), down.y()), r.around));
    }
  }
  // One kernel for the pixel's box and the blur.
  const int reach = int(std::ceil(4 * r.blur_px * kParts)) + kParts;
  std::vector<double> kernel(2 * reach + 1, 0);
  for (int i = -reach; i <= reach; ++i) {
    for (int b = -(kParts / 2); b <= kParts / 2; ++b) {
      const double d = double(i - b) / kParts;
      kernel[i + reach] += r.blur_px > 0 ? std::exp(-d * d / (2 * r.blur_px * r.blur_px)) : d == 0;
    }
  }
  double total = 0;
  for (double k : kernel) total += k;
  std::vector<double> across(std::size_t(r.width) * rows);
  const auto tap = [&](int i, int centre) { return std::clamp(centre + i - reach, 0, 1 << 30); };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < r.width; ++x) {
      double sum = 0;
      for (int i = 0; i <= 2 * reach; ++i) {
        const int at = std::min(tap(i, (x + pad) * kParts + kParts / 2), columns - 1);
        sum += kernel[i] * fine[std::size_t(y) * columns + at];
      }
      across[std::size_t(y) * r.width + x] = sum / total;
    }
  }
  Picture picture{r.width, r.height, std::vector<std::uint8_t>(std::size_t(r.width) * r.height)};
  std::mt19937 random(r.seed);
  std::normal_distribution<double> noise(0, 1);
  for (int y = 0; y < r.height; ++y) {
    for (int x = 0; x < r.width; ++x) {
      double sum = 0;
      for (int i = 0; i <= 2 * reach; ++i) {
        const int at = std::min(tap(i, (y + pad) * kParts + kParts / 2), rows - 1);
        sum += kernel[i] * across[std::size_t(at) * r.width + x];
      }
      const double value = r.black + (r.white - r.black) * sum / total + r.noise * noise(random);
      picture.grey[std::size_t(y) * r.width + x] =
          std::uint8_t(std::clamp(std::lround(value), 0L, 255L));
    }
  }
  return picture;
}

/// Homography that takes the corners of the square −1 … 1 (order of tagCorners) to these pixels.
inline Eigen::Matrix3d squareToPixels(const std::array<Eigen::Vector2d, 4>& px) {
  Eigen::Matrix<double, 8, 8> A;
  Eigen::Matrix<double, 8, 1> b;
  const double X[4] = {-1, 1, 1, -1}, Y[4] = {-1, -1, 1, 1};
  for (int i = 0; i < 4; ++i) {
    const double u = px[i].x(), v = px[i].y();
    A.row(2 * i) << X[i], Y[i], 1, 0, 0, 0, -u * X[i], -u * Y[i];
    A.row(2 * i + 1) << 0, 0, 0, X[i], Y[i], 1, -v * X[i], -v * Y[i];
    b.segment<2>(2 * i) = px[i];
  }
  const Eigen::VectorXd h = Eigen::MatrixXd(A).partialPivLu().solve(Eigen::VectorXd(b));
  Eigen::Matrix3d H;
  H << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  return H;
}

}  // namespace slamscope::tracking::testing
