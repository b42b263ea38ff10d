// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "apps/lib/view/resampler.hpp"
#include "engine/gpu/device_info.hpp"
#include "engine/scene/view.hpp"
#include "tracking/camera_info.hpp"
#include "tracking/frame.hpp"

namespace slamscope::apps {

/// The camera of the drawn picture: the source camera without its lens, at the output's size.
struct OutputCamera {
  engine::Pinhole pinhole;
  std::shared_ptr<const engine::LookupMap> map;  ///< none where pixels are the source's own
  std::shared_ptr<const Resampler> resampler;    ///< through the map
};

/// Same field of view as the source (as K tells it), scaled by one factor and centred; square
/// pixels stay square. width, height ≤ 0: the source's size.
[[nodiscard]] OutputCamera makeOutputCamera(const tracking::CameraInfo& source, int width,
                                            int height);

/// The frame behind the scene, as the engine takes it. A processor that plays the device samples
/// pictures some ten times slower than OpenCV does: there the frame is undistorted before it goes,
/// to 1/32 px; a real device does it itself by the camera's map.
[[nodiscard]] engine::Background backgroundOf(const tracking::Frame& frame,
                                              const OutputCamera& camera,
                                              const engine::DeviceInfo& device);

}  // namespace slamscope::apps
