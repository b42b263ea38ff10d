// SPDX-License-Identifier: MIT
#include "tracking/lab_sensor.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace slamscope::tracking::lab {
namespace {

constexpr int kSlack = 509;  // how far the noise field reaches beyond the picture, px
constexpr int kChannels = 3;

cv::Mat view(const Canvas& canvas) {
  static_assert(sizeof(Eigen::Array3f) == kChannels * sizeof(float));
  return {canvas.height, canvas.width, CV_32FC3, const_cast<Eigen::Array3f*>(canvas.pixels.data())};
}

/// Noise whose *grey* value (0.114 B + 0.587 G + 0.299 R) has the standard deviation asked for,
/// most of it common to the three channels.
std::vector<float> makeNoise(int width, int height, double sigma, std::uint64_t seed) {
  if (sigma == 0) return {};
  std::vector<float> noise(static_cast<std::size_t>(width) * height * kChannels);
  cv::RNG random(hash(seed ^ 0x5eed));
  const double own = 0.4,
               grey_of_own = own * std::sqrt(0.114 * 0.114 + 0.587 * 0.587 + 0.299 * 0.299);
  const double common = std::sqrt(1 - grey_of_own * grey_of_own);
  cv::Mat field(height, width, CV_32FC3, noise.data());
  random.fill(field, cv::RNG::NORMAL, 0, own * sigma);
  cv::Mat grey(height, width, CV_32F);
  random.fill(grey, cv::RNG::NORMAL, 0, common * sigma);
  cv::Mat spread;
  cv::cvtColor(grey, spread, cv::COLOR_GRAY2BGR);
  field += spread;
  return noise;
}

}  // namespace

Sensor::Sensor(const LabOptions& options)
    : width_(options.camera.width),
      height_(options.camera.height),
      margin_(static_cast<int>(std::ceil(4 * options.defocus_px))),
      defocus_px_(options.defocus_px),
      vignette_(options.vignette),
      seed_(options.seed),
      noise_(makeNoise(width_ + kSlack, height_ + kSlack, options.noise, options.seed)) {}

void Sensor::expose(const Canvas& light, const Region& region, Canvas& exposed) const {
  if (region.empty()) return;
  const Region source = region.grown(margin_, width_, height_);
  const cv::Rect rect(source.left, source.top, source.right - source.left,
                      source.bottom - source.top);
  cv::Mat blurred = view(light)(rect).clone();
  if (margin_ > 0)
    cv::GaussianBlur(blurred, blurred, cv::Size(2 * margin_ + 1, 2 * margin_ + 1), defocus_px_,
                     defocus_px_, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  const double corner = std::hypot(width_, height_) / 2;
  for (int row = region.top; row < region.bottom; ++row) {
    const auto* from = blurred.ptr<cv::Vec3f>(row - source.top) - source.left;
    for (int column = region.left; column < region.right; ++column) {
      const double x = (column - (width_ - 1) / 2.0) / corner,
                   y = (row - (height_ - 1) / 2.0) / corner;
      const auto gain = static_cast<float>(1 - vignette_ * (x * x + y * y));
      const cv::Vec3f& light_here = from[column];
      exposed.at(column, row) = gain * Eigen::Array3f(light_here[0], light_here[1], light_here[2]);
    }
  }
}

std::vector<std::uint8_t> Sensor::read(const Canvas& exposed, std::uint64_t k) const {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width_) * height_ * kChannels);
  cv::Mat out(height_, width_, CV_8UC3, bytes.data());
  if (noise_.empty()) {
    view(exposed).convertTo(out, CV_8U);
    return bytes;
  }
  const std::uint64_t place = hash(hash(seed_) ^ k);
  const cv::Mat field(height_ + kSlack, width_ + kSlack, CV_32FC3,
                      const_cast<float*>(noise_.data()));
  const cv::Rect rect(static_cast<int>(place % kSlack), static_cast<int>(place / kSlack % kSlack),
                      width_, height_);
  if ((place >> 63) != 0)
    cv::add(view(exposed), field(rect), out, cv::noArray(), CV_8U);
  else
    cv::subtract(view(exposed), field(rect), out, cv::noArray(), CV_8U);
  return bytes;
}

}  // namespace slamscope::tracking::lab
