// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "engine/gpu/descriptors.hpp"
#include "engine/gpu/image.hpp"
#include "engine/gpu/pipeline.hpp"
#include "engine/scene/lens.hpp"
#include "shaders/interop/lens.h"

namespace slamscope::engine {

/// The last pass: the drawn pictures of all eyes as their lenses need them, into pictures of its
/// own.
class LensPass {
 public:
  /// `drawn`: what it reads; must outlive it.
  LensPass(const gpu::Core& core, const gpu::DeviceImage& drawn);

  /// One lens a view. The device must not be drawing.
  void wear(std::span<const Lens> lenses);
  /// Takes `drawn` from gpu::drawnInto() and leaves shown() in gpu::copySource().
  void record(const vk::raii::CommandBuffer& commands) const;
  [[nodiscard]] const gpu::DeviceImage& shown() const { return shown_; }

 private:
  const gpu::DeviceImage& drawn_;
  gpu::DeviceImage shown_;
  gpu::Buffer lenses_;
  gpu::DescriptorSet set_;
  gpu::Pipeline pipeline_;
  vk::raii::Sampler sampler_;
};

}  // namespace slamscope::engine
