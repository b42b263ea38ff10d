// SPDX-License-Identifier: MIT
#include "apps/lib/view/resampler.hpp"

#include <array>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace slamscope::apps {
namespace {

cv::Mat pixelsOf(engine::Image& image, int width, int height) {
  image.width = width;
  image.height = height;
  image.rgba.resize(std::size_t{4} * static_cast<std::size_t>(width) *
                    static_cast<std::size_t>(height));
  return {height, width, CV_8UC4, image.rgba.data()};
}

}  // namespace

struct Resampler::Maps {
  /// As OpenCV remaps quickest: whole pixels, and an index of 32 × 32 places between them.
  struct FixedMap {
    cv::Mat whole, between;

    explicit FixedMap(const engine::LookupMap& map) {
      const cv::Mat uv(map.height, map.width, CV_32FC2, const_cast<float*>(map.uv_px.data()));
      cv::convertMaps(uv, cv::noArray(), whole, between, CV_16SC2);
    }
    void remap(const cv::Mat& from, cv::Mat& to) const {
      cv::remap(from, to, whole, between, cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                cv::Scalar(0, 0, 0, 255));
    }
    [[nodiscard]] int width() const { return whole.cols; }
    [[nodiscard]] int height() const { return whole.rows; }
  };

  std::vector<FixedMap> maps;
};

Resampler::Resampler(std::span<const engine::LookupMap> maps) : maps_(std::make_unique<Maps>()) {
  if (maps.size() != 1 && maps.size() != 3) {
    throw std::invalid_argument("a resampler takes 1 map or 3, not " + std::to_string(maps.size()));
  }
  for (const engine::LookupMap& map : maps) maps_->maps.emplace_back(map);
}
Resampler::~Resampler() = default;
Resampler::Resampler(Resampler&&) noexcept = default;
Resampler& Resampler::operator=(Resampler&&) noexcept = default;

void Resampler::operator()(const engine::Image& picture, engine::Image& result) const {
  const cv::Mat from(picture.height, picture.width, CV_8UC4,
                     const_cast<std::uint8_t*>(picture.rgba.data()));
  const auto& maps = maps_->maps;
  cv::Mat to = pixelsOf(result, maps[0].width(), maps[0].height());
  if (maps.size() == 1) return maps[0].remap(from, to);
  to.setTo(cv::Scalar(0, 0, 0, 255));
  cv::Mat plane, remapped;
  for (int colour = 0; colour < 3; ++colour) {
    cv::extractChannel(from, plane, colour);
    maps[static_cast<std::size_t>(colour)].remap(plane, remapped);
    cv::insertChannel(remapped, to, colour);
  }
}

void Resampler::operator()(const tracking::Frame& frame, engine::Image& result) const {
  if (maps_->maps.size() != 1) throw std::logic_error("frames have one map for all colours");
  const cv::Mat bgr(frame.height, frame.width, CV_8UC3,
                    const_cast<std::uint8_t*>(frame.bgr.data()));
  const auto& map = maps_->maps[0];
  cv::Mat straight;
  map.remap(bgr, straight);
  cv::cvtColor(straight, pixelsOf(result, map.width(), map.height()), cv::COLOR_BGR2RGBA);
}

}  // namespace slamscope::apps
