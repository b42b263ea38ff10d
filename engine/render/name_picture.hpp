// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/gpu/submission.hpp"
#include "engine/render/renderer.hpp"

namespace slamscope::engine {

/// A few pixels of what was drawn last, drawn once more with each glyph's name in place of its
/// colour: what a pixel shows is what its name says, however it was drawn.
class NamePicture {
 public:
  NamePicture(const gpu::Core& core, const gpu::DeviceImage& like);

  /// Draws, with `depth` for depth, and waits.
  [[nodiscard]] std::optional<Picked> pick(gpu::Submission& submission, const Renderer& renderer,
                                           const gpu::DeviceImage& depth, const PickPlace& place);

 private:
  gpu::DeviceImage names_;
  gpu::Buffer texels_;
};

}  // namespace slamscope::engine
