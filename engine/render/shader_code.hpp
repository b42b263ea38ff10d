// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

// The compiled shaders, part of the program.
namespace slamscope::engine {

struct ShaderCode {
  std::string_view name;  ///< file in shaders/, '.' replaced by '_': "ellipsoids_frag"
  std::span<const std::uint32_t> words;
};

[[nodiscard]] std::span<const ShaderCode> allShaders();

/// Throws std::out_of_range for a name that there isn't.
[[nodiscard]] std::span<const std::uint32_t> shaderCode(std::string_view name);

}  // namespace slamscope::engine
