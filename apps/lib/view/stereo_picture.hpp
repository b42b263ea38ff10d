// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "apps/lib/view/eye_layout.hpp"
#include "apps/lib/view/output_camera.hpp"
#include "apps/lib/view/resampler.hpp"
#include "engine/render/offscreen.hpp"
#include "tracking/rig.hpp"
#include "tracking/stereo_source.hpp"

namespace slamscope::apps {

struct StereoPictureOptions {
  int width = 0, height = 0;  ///< of one eye, px; 0: the left camera's
  EyeLayout layout = EyeLayout::side_by_side;
  bool swap_eyes = false;
};

/// Both eyes' pictures in one, for a display worn on the head: each camera's frame without its
/// lens's distortion, the scene drawn over it, then both through the display's lenses.
class StereoPicture {
 public:
  /// A rig of two eyes (see drawnRig).
  StereoPicture(std::shared_ptr<engine::Gpu> gpu, const tracking::Rig& rig,
                const StereoPictureOptions& options);

  /// What stands behind; an eye without a frame before black.
  void takeFrames(const tracking::StereoFrame& frames);
  /// From where each eye looks: cameras are set, poses the caller's.
  [[nodiscard]] std::array<engine::View, 2>& views() { return views_; }
  [[nodiscard]] const std::array<engine::View, 2>& views() const { return views_; }

  const engine::Image& draw(const engine::Scene& scene, const engine::RenderOptions& options);
  [[nodiscard]] const engine::Image& drawn() const { return both_; }
  /// Which of views() a pixel of drawn() shows, and where in what the engine drew of it.
  [[nodiscard]] EyePixel underLens(const Eigen::Vector2d& pixel) const;
  [[nodiscard]] engine::Offscreen& offscreen() { return offscreen_; }
  [[nodiscard]] const engine::FrameStats& lastStats() const { return offscreen_.lastStats(); }

 private:
  void wearLenses();

  std::shared_ptr<engine::Gpu> gpu_;
  StereoPictureOptions options_;
  std::array<OutputCamera, 2> cameras_;
  std::array<tracking::DisplayLens, 2> displays_;
  std::array<engine::View, 2> views_;
  engine::Offscreen offscreen_;
  std::array<std::optional<Resampler>, 2> resamplers_;  // where the device doesn't do it
  std::vector<engine::Image> eyes_;
  std::array<engine::Image, 2> shown_;  // through the lenses
  engine::Image both_;
};

}  // namespace slamscope::apps
