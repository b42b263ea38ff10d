// SPDX-License-Identifier: MIT
#include "tracking/board.hpp"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "tracking/tag_detector.hpp"

namespace slamscope::tracking {
namespace {

constexpr std::size_t kLeastTags = 4;

cv::Mat greyOf(const ImageView& picture) {
  const cv::Mat view(picture.height, picture.width, picture.channels == 1 ? CV_8UC1 : CV_8UC3,
                     const_cast<std::uint8_t*>(picture.pixels), picture.row_bytes);
  if (picture.channels == 1) return view;
  cv::Mat grey;
  cv::cvtColor(view, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

std::optional<BoardSight> findChessboard(const ImageView& picture, const Board& board) {
  if (board.columns < 3 || board.rows < 3) {
    throw std::invalid_argument("a chessboard needs at least 3 x 3 inner corners");
  }
  const cv::Mat grey = greyOf(picture);
  const cv::Size size(board.columns, board.rows);
  std::vector<cv::Point2f> corners;
  const int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(grey, size, corners, flags)) return std::nullopt;
  // As wide as squares allow: a third of the least distance between corners.
  double least = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    least = std::min(least, cv::norm(corners[i] - corners[i - 1]));
  }
  const int half = std::clamp(static_cast<int>(least / 3), 2, 9);
  cv::cornerSubPix(grey, corners, cv::Size(half, half), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 60, 1e-4));
  BoardSight sight;
  for (int i = 0; i < board.columns * board.rows; ++i) {
    sight.p_board.emplace_back(i % board.columns * board.size_m, i / board.columns * board.size_m,
                               0);
    const cv::Point2f& corner = corners[static_cast<std::size_t>(i)];
    sight.px.emplace_back(corner.x, corner.y);
  }
  return sight;
}

std::optional<BoardSight> findGrid(const ImageView& picture, const Board& board) {
  TagDetectorOptions options;
  options.family = board.family;
  TagDetector detector(options);
  BoardSight sight;
  const double pitch = board.size_m * (1 + board.spacing);
  for (const TagDetection& tag : detector.detect(picture)) {
    const int index = tag.id - board.first_id;
    if (index < 0 || index >= board.columns * board.rows || !tag.refined) continue;
    // Board: y down the rows; tags: y up, first corner lower left.
    const Eigen::Vector3d upper_left(index % board.columns * pitch, index / board.columns * pitch,
                                     0);
    const auto p_tag = tagCorners(board.size_m);
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d off(p_tag[i].x() + board.size_m / 2, board.size_m / 2 - p_tag[i].y(),
                                0);
      sight.p_board.push_back(upper_left + off);
      sight.px.push_back(tag.corners_px[i]);
    }
  }
  if (sight.px.size() < 4 * kLeastTags) return std::nullopt;
  return sight;
}

}  // namespace

std::optional<BoardSight> findBoard(const ImageView& picture, const Board& board) {
  return board.kind == Board::Kind::chessboard ? findChessboard(picture, board)
                                               : findGrid(picture, board);
}

}  // namespace slamscope::tracking
