// SPDX-License-Identifier: MIT
#include "apps/lib/view/stereo_picture.hpp"

#include <algorithm>

namespace slamscope::apps {
namespace {

using tracking::DisplayLens;

/// Both eyes at one size, each with its own K.
std::array<OutputCamera, 2> eyeCameras(const tracking::Rig& rig,
                                       const StereoPictureOptions& options) {
  const bool given = options.width > 0 && options.height > 0;
  const int width = given ? options.width : rig.cameras[0].info.width;
  const int height = given ? options.height : rig.cameras[0].info.height;
  return {makeOutputCamera(rig.cameras[0].info, width, height),
          makeOutputCamera(rig.cameras[1].info, width, height)};
}

engine::Lens deviceLens(const DisplayLens& display) {
  const auto& blue_green_red = display.colour_scale;
  return {.centre = display.centre,
          .k = {display.k[0], display.k[1], display.k[2]},
          .scale = Eigen::Vector3d(blue_green_red[2], blue_green_red[1], blue_green_red[0]) /
                   display.zoom};
}

engine::LookupMap lensMap(const DisplayLens& lens, int width, int height, int channel) {
  engine::LookupMap map{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Eigen::Vector2d px =
          tracking::shownAt(lens, Eigen::Vector2d(column, row), width, height, channel);
      map.uv_px.insert(map.uv_px.end(), {static_cast<float>(px.x()), static_cast<float>(px.y())});
    }
  }
  return map;
}

Resampler lensResampler(const DisplayLens& lens, int width, int height) {
  std::vector<engine::LookupMap> maps;  // red, green, blue
  const auto& scale = lens.colour_scale;
  const bool one_for_all = scale[0] == scale[1] && scale[1] == scale[2];
  for (const int channel : {2, 1, 0}) {
    if (maps.empty() || !one_for_all) maps.push_back(lensMap(lens, width, height, channel));
  }
  return Resampler(maps);
}

}  // namespace

StereoPicture::StereoPicture(std::shared_ptr<engine::Gpu> gpu, const tracking::Rig& rig,
                             const StereoPictureOptions& options)
    : gpu_(std::move(gpu)),
      options_(options),
      cameras_(eyeCameras(rig, options)),
      displays_{rig.cameras[0].display, rig.cameras[1].display},
      offscreen_(gpu_, cameras_[0].pinhole.width, cameras_[0].pinhole.height, 2) {
  for (std::size_t eye = 0; eye < views_.size(); ++eye) views_[eye].camera = cameras_[eye].pinhole;
  wearLenses();
}

void StereoPicture::wearLenses() {
  std::array<engine::Lens, 2> lenses;
  for (std::size_t eye = 0; eye < lenses.size(); ++eye) {
    const DisplayLens& display = displays_[eye];
    if (gpu_->device().type != "cpu") {
      lenses[eye] = deviceLens(display);
    } else if (!display.plain()) {
      const engine::Pinhole& size = cameras_[eye].pinhole;
      resamplers_[eye].emplace(lensResampler(display, size.width, size.height));
    }
  }
  offscreen_.wear(lenses);
}

void StereoPicture::takeFrames(const tracking::StereoFrame& frames) {
  for (std::size_t eye = 0; eye < views_.size(); ++eye) {
    const auto& frame = frames.eyes[eye];
    views_[eye].background =
        frame ? backgroundOf(*frame, cameras_[eye], gpu_->device()) : engine::Background{};
  }
}

const engine::Image& StereoPicture::draw(const engine::Scene& scene,
                                         const engine::RenderOptions& options) {
  offscreen_.draw(views_, scene, options, eyes_);
  for (std::size_t eye = 0; eye < resamplers_.size(); ++eye) {
    if (!resamplers_[eye]) continue;
    (*resamplers_[eye])(eyes_[eye], shown_[eye]);
    std::swap(eyes_[eye], shown_[eye]);
  }
  const bool swapped = options_.swap_eyes;
  layOut(options_.layout, eyes_[swapped ? 1 : 0], eyes_[swapped ? 0 : 1], both_);
  return both_;
}

EyePixel StereoPicture::underLens(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2i size(cameras_[0].pinhole.width, cameras_[0].pinhole.height);
  EyePixel shown = eyePixel(options_.layout, size, pixel);
  if (options_.swap_eyes) shown.eye = 1 - shown.eye;
  const auto eye = static_cast<std::size_t>(shown.eye);
  shown.pixel = engine::drawnPixel(deviceLens(displays_[eye]), size.cast<double>(), shown.pixel);
  return shown;
}

}  // namespace slamscope::apps
