// SPDX-License-Identifier: MIT
#include "apps/lib/view/output_camera.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "tracking/camera_model.hpp"
#include "tracking/undistort.hpp"

namespace slamscope::apps {

OutputCamera makeOutputCamera(const tracking::CameraInfo& source, int width, int height) {
  if (width <= 0 || height <= 0) {
    width = source.width;
    height = source.height;
  }
  const double scale = std::min(static_cast<double>(width) / source.width,
                                static_cast<double>(height) / source.height);
  // Pixel centres are integers, so the scaling is about the picture's corner at −0.5.
  const auto scaled = [scale](double centre, int from, int to) {
    return (centre + 0.5 - 0.5 * from) * scale + 0.5 * to - 0.5;
  };
  OutputCamera output;
  output.pinhole = {.width = width,
                    .height = height,
                    .fx = source.K(0, 0) * scale,
                    .fy = source.K(1, 1) * scale,
                    .cx = scaled(source.K(0, 2), source.width, width),
                    .cy = scaled(source.K(1, 2), source.height, height),
                    .skew = source.K(0, 1) * scale};
  const bool own_pixels = tracking::CameraModel(source).undistorted() && width == source.width &&
                          height == source.height;
  if (own_pixels) return output;

  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = output.pinhole.fx;
  K(0, 1) = output.pinhole.skew;
  K(0, 2) = output.pinhole.cx;
  K(1, 1) = output.pinhole.fy;
  K(1, 2) = output.pinhole.cy;
  tracking::UndistortMap map = tracking::undistortMap(source, K, width, height);
  output.map = std::make_shared<engine::LookupMap>(
      engine::LookupMap{.width = width, .height = height, .uv_px = std::move(map.uv)});
  output.resampler = std::make_shared<Resampler>(std::span(output.map.get(), 1));
  return output;
}

engine::Background backgroundOf(const tracking::Frame& frame, const OutputCamera& camera,
                                const engine::DeviceInfo& device) {
  auto image = std::make_shared<engine::Image>();
  if (camera.map && device.type == "cpu") {
    (*camera.resampler)(frame, *image);
    return {.image = std::move(image), .map = nullptr};
  }
  const cv::Mat bgr(frame.height, frame.width, CV_8UC3,
                    const_cast<std::uint8_t*>(frame.bgr.data()));
  image->width = frame.width;
  image->height = frame.height;
  image->rgba.resize(bgr.total() * 4);
  cv::Mat rgba(bgr.rows, bgr.cols, CV_8UC4, image->rgba.data());
  cv::cvtColor(bgr, rgba, cv::COLOR_BGR2RGBA);
  return {.image = std::move(image), .map = camera.map};
}

}  // namespace slamscope::apps
