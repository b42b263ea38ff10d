// SPDX-License-Identifier: MIT
#include "tracking/camera_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <opencv2/calib3d.hpp>
#include <set>
#include <stdexcept>

namespace slamscope::tracking {
namespace {

constexpr std::size_t kLeastPictures = 4, kGoodPictures = 10;
constexpr double kLeastCoverage = 0.25, kGoodCoverage = 0.6;
constexpr double kLeastTilt = 0.2;        // rad, between two of the pictures
constexpr double kMostFocalSigma = 0.02;  // part of it

struct CvSights {
  std::vector<std::vector<cv::Point3f>> board;
  std::vector<std::vector<cv::Point2f>> px;
};

CvSights toCv(const std::vector<BoardSight>& pictures) {
  CvSights sights;
  for (const BoardSight& picture : pictures) {
    auto& board = sights.board.emplace_back();
    auto& px = sights.px.emplace_back();
    for (const Eigen::Vector3d& p : picture.p_board) {
      board.emplace_back(float(p.x()), float(p.y()), float(p.z()));
    }
    for (const Eigen::Vector2d& p : picture.px) px.emplace_back(float(p.x()), float(p.y()));
  }
  return sights;
}

/// Part of an 8 × 6 raster over the picture that holds a point.
double coverageOf(const std::vector<BoardSight>& pictures, int width, int height) {
  constexpr int kAcross = 8, kDown = 6;
  std::set<int> cells;
  for (const BoardSight& picture : pictures) {
    for (const Eigen::Vector2d& p : picture.px) {
      const int column = std::clamp(static_cast<int>(p.x() * kAcross / width), 0, kAcross - 1);
      const int row = std::clamp(static_cast<int>(p.y() * kDown / height), 0, kDown - 1);
      cells.insert(row * kAcross + column);
    }
  }
  return static_cast<double>(cells.size()) / (kAcross * kDown);
}

template <typename... Values>
std::string sentence(const char* format, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// Greatest angle between the board's planes of two pictures, rad.
double tiltOf(const std::vector<cv::Mat>& rotations) {
  std::vector<Eigen::Vector3d> normals;
  for (const cv::Mat& rotation : rotations) {
    cv::Matx33d R;
    cv::Rodrigues(rotation, R);
    normals.emplace_back(R(0, 2), R(1, 2), R(2, 2));
  }
  double most = 0;
  for (const auto& a : normals) {
    for (const auto& b : normals) most = std::max(most, std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
  }
  return most;
}

void refuseWeak(const CameraCalibration& result, double tilt, std::size_t pictures) {
  if (tilt < kLeastTilt) {
    throw std::runtime_error(
        "the board is held the same way in all pictures; tilt it by 30 degrees and more, to all "
        "sides");
  }
  const double f = result.info.K(0, 0);
  if (!(result.sigma_focal_px < kMostFocalSigma * f)) {
    throw std::runtime_error(
        sentence("focal length is known to ±%.1f %% only, from %zu pictures; tilt the board more, "
                 "and bring it closer",
                 100 * result.sigma_focal_px / f, pictures));
  }
}

void hint(CameraCalibration& result, std::size_t pictures) {
  if (pictures < kGoodPictures) {
    result.hints.push_back(sentence("%zu pictures; ten and more are better", pictures));
  }
  if (result.coverage < kGoodCoverage) {
    result.hints.push_back(
        sentence("points in %.0f %% of the picture; bring the board into its corners too",
                 100 * result.coverage));
  }
  const double typical = result.residual_px;
  for (std::size_t i = 0; i < result.picture_px.size(); ++i) {
    if (result.picture_px[i] < 2.5 * typical || result.picture_px[i] < 0.3) continue;
    result.hints.push_back(
        sentence("picture %zu fits worst, %.2f px; blurred?", i, result.picture_px[i]));
  }
}

Eigen::Matrix3d matrixOfCv(const cv::Mat& M) {
  Eigen::Matrix3d result;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) result(r, c) = M.at<double>(r, c);
  }
  return result;
}

cv::Mat cameraOf(const CameraInfo& info) {
  return (cv::Mat_<double>(3, 3) << info.K(0, 0), 0, info.K(0, 2), 0, info.K(1, 1), info.K(1, 2), 0,
          0, 1);
}

/// A chessboard in the right picture may count its corners from the other end: the order that has
/// the same point up in both pictures.
BoardSight sameOrder(const BoardSight& left, BoardSight right) {
  if (left.px.size() != right.px.size() || left.px.size() < 2) return right;
  const Eigen::Vector2d along = left.px.back() - left.px.front();
  if (along.dot(right.px.back() - right.px.front()) < 0)
    std::reverse(right.px.begin(), right.px.end());
  return right;
}

/// Points that both see, of boards of which either may see a part.
void keepCommon(BoardSight& left, BoardSight& right) {
  const auto key = [](const Eigen::Vector3d& p) {
    return std::pair(std::lround(1e5 * p.x()), std::lround(1e5 * p.y()));
  };
  std::map<std::pair<long, long>, Eigen::Vector2d> of_right;
  for (std::size_t i = 0; i < right.px.size(); ++i) of_right[key(right.p_board[i])] = right.px[i];
  BoardSight a, b;
  for (std::size_t i = 0; i < left.px.size(); ++i) {
    const auto other = of_right.find(key(left.p_board[i]));
    if (other == of_right.end()) continue;
    a.p_board.push_back(left.p_board[i]);
    a.px.push_back(left.px[i]);
    b.p_board.push_back(left.p_board[i]);
    b.px.push_back(other->second);
  }
  left = std::move(a);
  right = std::move(b);
}

CameraCalibration calibrateNamed(const char* which, const std::vector<BoardSight>& pictures,
                                 int width, int height) {
  try {
    return calibrateCamera(pictures, width, height);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(which) + " camera: " + error.what());
  }
}

}  // namespace

CameraCalibration calibrateCamera(const std::vector<BoardSight>& pictures, int width, int height) {
  if (pictures.size() < kLeastPictures) {
    throw std::runtime_error(sentence("the board is seen in %zu pictures; expected at least %zu",
                                      pictures.size(), kLeastPictures));
  }
  CameraCalibration result;
  result.coverage = coverageOf(pictures, width, height);
  if (result.coverage < kLeastCoverage) {
    throw std::runtime_error(
        sentence("the board's points lie in %.0f %% of the picture; expected at least %.0f %%",
                 100 * result.coverage, 100 * kLeastCoverage));
  }
  const CvSights sights = toCv(pictures);
  cv::Mat K, D, deviations, extrinsic_deviations, errors;
  std::vector<cv::Mat> rotations, translations;
  // Few pictures don't tell k3 from noise.
  const int flags = pictures.size() < kGoodPictures ? cv::CALIB_FIX_K3 : 0;
  result.residual_px =
      cv::calibrateCamera(sights.board, sights.px, cv::Size(width, height), K, D, rotations,
                          translations, deviations, extrinsic_deviations, errors, flags);
  result.info.width = width;
  result.info.height = height;
  result.info.K = matrixOfCv(K);
  for (int i = 0; i < 5; ++i) result.info.D.push_back(D.at<double>(i));
  result.sigma_focal_px = deviations.at<double>(0);
  for (int i = 0; i < errors.rows; ++i) result.picture_px.push_back(errors.at<double>(i));
  refuseWeak(result, tiltOf(rotations), pictures.size());
  hint(result, pictures.size());
  return result;
}

StereoCalibration calibrateStereo(const std::vector<BoardSight>& left,
                                  const std::vector<BoardSight>& right, int width, int height) {
  if (left.size() != right.size()) {
    throw std::runtime_error(
        sentence("%zu pictures of the left camera, %zu of the right", left.size(), right.size()));
  }
  StereoCalibration result;
  result.left = calibrateNamed("left", left, width, height);
  result.right = calibrateNamed("right", right, width, height);
  result.left.info.name = "left";
  result.right.info.name = "right";
  std::vector<BoardSight> a = left, b = right;
  for (std::size_t i = 0; i < a.size(); ++i) {
    b[i] = sameOrder(a[i], b[i]);
    keepCommon(a[i], b[i]);
  }
  const CvSights of_left = toCv(a), of_right = toCv(b);
  cv::Mat K1 = cameraOf(result.left.info), K2 = cameraOf(result.right.info);
  cv::Mat D1(result.left.info.D, true), D2(result.right.info.D, true), R, T, E, F, errors;
  result.residual_px =
      cv::stereoCalibrate(of_left.board, of_left.px, of_right.px, K1, D1, K2, D2,
                          cv::Size(width, height), R, T, E, F, errors, cv::CALIB_FIX_INTRINSIC);
  for (int i = 0; i < errors.rows; ++i) {
    result.picture_px.push_back(std::hypot(errors.at<double>(i, 0), errors.at<double>(i, 1)) /
                                std::sqrt(2.0));
  }
  result.rig.cameras.push_back({.info = result.left.info, .display = {}});
  result.rig.cameras.push_back({.info = result.right.info, .display = {}});
  result.rig.T_right_left.linear() = matrixOfCv(R);
  for (int i = 0; i < 3; ++i) result.rig.T_right_left.translation()[i] = T.at<double>(i);
  return result;
}

}  // namespace slamscope::tracking
