// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/gpu/gpu.hpp"

namespace slamscope::engine::gpu {

/// Runs a compute shader once: binding 0 of set 0 is `input`, binding 1 the output, both storage
/// buffers; `groups` work groups along x. Waits and returns the output.
[[nodiscard]] std::vector<std::byte> runCompute(const Gpu& gpu, std::span<const std::uint32_t> code,
                                                std::span<const std::byte> input,
                                                std::size_t output_bytes, std::uint32_t groups = 1);

}  // namespace slamscope::engine::gpu
