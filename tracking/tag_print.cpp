// SPDX-License-Identifier: MIT
#include "tracking/tag_print.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace slamscope::tracking {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

/// Homography from the unit square, (0, 0) the tag's upper left corner and y down, to pixels.
Matrix3d squareToPixels(const std::array<Vector2d, 4>& corners_px) {
  const std::array<cv::Point2f, 4> square{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  std::array<cv::Point2f, 4> px;
  for (std::size_t i = 0; i < 4; ++i) {
    px[i] = {static_cast<float>(corners_px[i].x()), static_cast<float>(corners_px[i].y())};
  }
  const cv::Mat H = cv::getPerspectiveTransform(square.data(), px.data());
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(H.ptr<double>());
}

/// Grey level between pixels; NaN out of the picture.
double greyAt(const ImageView& grey, const Vector2d& px) {
  const double column = std::floor(px.x()), row = std::floor(px.y());
  const bool inside = column >= 0 && row >= 0 && column < grey.width - 1 && row < grey.height - 1;
  if (!inside) return std::numeric_limits<double>::quiet_NaN();
  const double u = px.x() - column, v = px.y() - row;
  const std::uint8_t* above = grey.pixels + static_cast<std::size_t>(row) * grey.row_bytes +
                              static_cast<std::size_t>(column);
  const std::uint8_t* below = above + grey.row_bytes;
  return (1 - v) * ((1 - u) * above[0] + u * above[1]) + v * ((1 - u) * below[0] + u * below[1]);
}

}  // namespace

PrintMatch comparePrint(const ImageView& grey, const std::array<Vector2d, 4>& corners_px,
                        const TagCells& print) {
  const Matrix3d H = squareToPixels(corners_px);
  std::vector<double> seen;
  double sum[2] = {0, 0};  // of white, black cells
  int count[2] = {0, 0};
  for (int row = 0; row < print.size; ++row) {
    for (int column = 0; column < print.size; ++column) {
      const double cell = 1.0 / print.across_black;
      const Vector3d p =
          H * Vector3d((column - print.border + 0.5) * cell, (row - print.border + 0.5) * cell, 1);
      seen.push_back(greyAt(grey, p.hnormalized()));
      sum[print.black(column, row) ? 1 : 0] += seen.back();
      ++count[print.black(column, row) ? 1 : 0];
    }
  }
  const double white = sum[0] / count[0], black = sum[1] / count[1];
  PrintMatch match;
  if (!std::isfinite(white + black)) return {.whole_edge = false, .in_picture = false};
  match.margin = (white - black) / 2;
  const double between = (white + black) / 2;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (print.is_black[i] ? seen[i] < between : seen[i] > between) continue;
    ++match.wrong;
    const int size = print.size;
    const int row = static_cast<int>(i) / size, column = static_cast<int>(i) % size;
    const int from_edge = std::min({row, column, size - 1 - row, size - 1 - column});
    if (from_edge == print.border - 1 || from_edge == print.border) match.whole_edge = false;
  }
  return match;
}

}  // namespace slamscope::tracking
