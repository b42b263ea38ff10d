// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/gpu/shader.hpp"

namespace slamscope::engine::gpu {

struct PipelineInfo {
  SpirV vertex = {}, fragment = {};
  std::vector<vk::DescriptorSetLayout> sets = {};
  std::uint32_t view_mask = 1;  ///< one bit a view, as in the rendering it is used in
  vk::Format colour_format = vk::Format::eR8G8B8A8Unorm;
  vk::Format depth_format = vk::Format::eD32Sfloat;
  bool blend = true;        ///< over what is there, by the alpha that the shader gives
  bool depth_test = false;  ///< nearer or equal wins; depth is reversed
  bool depth_write = false;
  bool colour_write = true;
  std::vector<std::uint32_t> constants = {};  ///< specialization constants 0, 1, …
};

/// Pipeline that draws triangle strips made by the vertex shader alone (no vertex input), into all
/// views of the mask at once; viewport and scissor are set while recording.
class Pipeline {
 public:
  Pipeline(const Core& core, const PipelineInfo& info);

  [[nodiscard]] vk::Pipeline handle() const { return *pipeline_; }
  [[nodiscard]] vk::PipelineLayout layout() const { return *layout_; }

 private:
  vk::raii::PipelineLayout layout_;
  vk::raii::Pipeline pipeline_ = nullptr;
};

}  // namespace slamscope::engine::gpu
