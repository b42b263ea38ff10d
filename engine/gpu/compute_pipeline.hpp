// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/gpu/shader.hpp"

namespace slamscope::engine::gpu {

/// A compute shader, ready to be dispatched.
class ComputePipeline {
 public:
  /// `constants`: specialization constants 0, 1, …
  ComputePipeline(const Core& core, SpirV code, const std::vector<vk::DescriptorSetLayout>& sets,
                  const std::vector<std::uint32_t>& constants = {});

  /// Makes it and its sets (0, 1, …) those of the next dispatch.
  void bind(const vk::raii::CommandBuffer& commands, std::span<const vk::DescriptorSet> sets) const;

 private:
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline pipeline_ = nullptr;
};

}  // namespace slamscope::engine::gpu
