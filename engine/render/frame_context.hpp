// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "engine/gpu/descriptors.hpp"
#include "engine/gpu/pipeline.hpp"
#include "engine/render/looks.hpp"
#include "engine/render/options.hpp"

namespace slamscope::engine {

/// What every pass is made with.
struct PassSetup {
  const gpu::Core& core;
  vk::DescriptorSetLayout frame_layout;  ///< set 0: the frame's views
  std::uint32_t view_mask = 1;
};

/// What every pass is recorded with.
struct FrameContext {
  const vk::raii::CommandBuffer& commands;
  vk::DescriptorSet frame_set;
  Look look = Look::lit;
  FrameStats& stats;

  /// One draw of a strip of `vertices` for each instance, into all views; counted under `pass`.
  void draw(const std::string& pass, const gpu::Pipeline& pipeline, vk::DescriptorSet pass_set,
            int vertices, int instances) const;
  /// The same for a number of instances that the device knows (vk::DrawIndirectCommand).
  void drawIndirect(const std::string& pass, const gpu::Pipeline& pipeline,
                    vk::DescriptorSet pass_set, vk::Buffer arguments, std::size_t offset) const;

 private:
  void bind(const gpu::Pipeline& pipeline, vk::DescriptorSet pass_set) const;
  [[nodiscard]] FrameStats::Pass& counted(const std::string& pass) const;
};

}  // namespace slamscope::engine
