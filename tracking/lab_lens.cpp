// SPDX-License-Identifier: MIT
#include "tracking/lab_lens.hpp"

#include <opencv2/calib3d.hpp>
#include <stdexcept>

namespace slamscope::tracking::lab {
namespace {

cv::Mat matrixOf(const CameraInfo& camera) {
  if (camera.K(0, 1) != 0)
    throw std::invalid_argument("the lab's camera can't have skew: OpenCV's model has none");
  return (cv::Mat_<double>(3, 3) << camera.K(0, 0), 0, camera.K(0, 2), 0, camera.K(1, 1),
          camera.K(1, 2), 0, 0, 1);
}

/// OpenCV wants exactly 5, 8 or (fisheye) 4.
cv::Mat coefficientsOf(const CameraInfo& camera) {
  const std::size_t wanted = camera.model == DistortionModel::plumb_bob     ? 5
                             : camera.model == DistortionModel::equidistant ? 4
                                                                            : 8;
  if (!camera.D.empty() && camera.D.size() != wanted && !(wanted == 5 && camera.D.size() == 4))
    throw std::invalid_argument("camera has " + std::to_string(camera.D.size()) +
                                " distortion coefficients where its model has " +
                                std::to_string(wanted));
  cv::Mat D = cv::Mat::zeros(1, static_cast<int>(wanted), CV_64F);
  std::copy(camera.D.begin(), camera.D.end(), D.begin<double>());
  return D;
}

}  // namespace

std::vector<Eigen::Vector2d> projectByOpenCv(const CameraInfo& camera,
                                             const std::vector<Eigen::Vector3d>& p_camera) {
  if (p_camera.empty()) return {};
  std::vector<cv::Point3d> points;
  for (const Eigen::Vector3d& p : p_camera) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<cv::Point2d> pixels;
  const cv::Vec3d none(0, 0, 0);
  if (camera.model == DistortionModel::equidistant)
    cv::fisheye::projectPoints(points, pixels, none, none, matrixOf(camera),
                               coefficientsOf(camera));
  else
    cv::projectPoints(points, none, none, matrixOf(camera), coefficientsOf(camera), pixels);
  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2d& p : pixels) result.emplace_back(p.x, p.y);
  return result;
}

Lens::Lens(const CameraInfo& camera) : width_(camera.width), height_(camera.height) {
  if (width_ <= 0 || height_ <= 0 || camera.K(0, 0) <= 0 || camera.K(1, 1) <= 0)
    throw std::invalid_argument("the lab's camera needs a size and a focal length");
  std::vector<cv::Point2d> pixels;
  pixels.reserve(static_cast<std::size_t>(width_ + 1) * (height_ + 1));
  for (int row = 0; row <= height_; ++row)
    for (int column = 0; column <= width_; ++column) pixels.emplace_back(column - 0.5, row - 0.5);
  std::vector<cv::Point2d> rays;
  // The default of 5 iterations leaves whole pixels at the edge of a wide lens.
  const cv::TermCriteria converged(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-7);
  if (camera.model == DistortionModel::equidistant)
    cv::fisheye::undistortPoints(pixels, rays, matrixOf(camera), coefficientsOf(camera),
                                 cv::noArray(), cv::noArray(), converged);
  else
    cv::undistortPoints(pixels, rays, matrixOf(camera), coefficientsOf(camera), cv::noArray(),
                        cv::noArray(), converged);
  for (const cv::Point2d& ray : rays) corners_.emplace_back(ray.x, ray.y);

  std::vector<Eigen::Vector3d> probes;
  std::vector<Eigen::Vector2d> wanted;
  for (std::size_t i = 0; i < rays.size(); i += 61) {
    probes.emplace_back(rays[i].x, rays[i].y, 1);
    wanted.emplace_back(pixels[i].x, pixels[i].y);
  }
  const std::vector<Eigen::Vector2d> back = projectByOpenCv(camera, probes);
  for (std::size_t i = 0; i < back.size(); ++i)
    if (!((back[i] - wanted[i]).norm() < 1e-3))
      throw std::invalid_argument(
          "the lab can't see through this lens: OpenCV finds no inverse at pixel " +
          std::to_string(wanted[i].x()) + ", " + std::to_string(wanted[i].y()));
}

}  // namespace slamscope::tracking::lab
