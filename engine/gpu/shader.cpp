// SPDX-License-Identifier: MIT
#include "engine/gpu/shader.hpp"

namespace slamscope::engine::gpu {

vk::raii::ShaderModule makeShader(const Core& core, SpirV code) {
  return {core.device(),
          vk::ShaderModuleCreateInfo{.codeSize = code.size_bytes(), .pCode = code.data()}};
}

}  // namespace slamscope::engine::gpu
