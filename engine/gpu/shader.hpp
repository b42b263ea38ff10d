// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/gpu/core.hpp"

namespace slamscope::engine::gpu {

using SpirV = std::span<const std::uint32_t>;

[[nodiscard]] vk::raii::ShaderModule makeShader(const Core& core, SpirV code);

}  // namespace slamscope::engine::gpu
