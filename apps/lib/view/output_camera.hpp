// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "engine/scene/view.hpp"
#include "tracking/camera_info.hpp"
#include "tracking/frame.hpp"

namespace slamscope::apps {

/// The camera of the drawn picture: the source camera without its lens, at the output's size.
struct OutputCamera {
  engine::Pinhole pinhole;
  std::shared_ptr<const engine::LookupMap> map;  ///< none where pixels are the source's own
};

/// Same field of view as the source (as K tells it), scaled by one factor and centred; square
/// pixels stay square. width, height ≤ 0: the source's size.
[[nodiscard]] OutputCamera makeOutputCamera(const tracking::CameraInfo& source, int width,
                                            int height);

/// The picture as the engine takes it.
[[nodiscard]] std::shared_ptr<const engine::Image> toImage(const tracking::Frame& frame);

}  // namespace slamscope::apps
