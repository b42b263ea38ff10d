// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "engine/gpu/pipeline.hpp"
#include "engine/scene/picked.hpp"

namespace slamscope::engine {

/// How all glyphs of one drawing look.
enum class Look {
  flat,   ///< in exactly their colours
  lit,    ///< RenderOptions::lit
  named,  ///< as numbers to be picked from (common/named.glsl)
};

/// What stands for a kind of glyph in names, three bits; 0 stands for nothing.
[[nodiscard]] constexpr std::uint32_t nameOf(Picked::Kind kind) {
  return static_cast<std::uint32_t>(kind) + 1;
}

/// What a pass draws with in each look, made when it is first drawn with. The fragment shader's
/// constants: 0 lit, 1 the pass's own, 2 nameOf() its kind
/// where named.
class Looks {
 public:
  /// `info`: of the looks to be seen; `part`: constant 1. Where named each pixel is the nearest
  /// glyph's: depth is written wherever it is tested.
  Looks(const gpu::Core& core, gpu::PipelineInfo info, std::uint32_t part, Picked::Kind kind);

  [[nodiscard]] const gpu::Pipeline& operator[](Look look) const;

 private:
  const gpu::Core* core_;
  gpu::PipelineInfo info_;
  std::uint32_t part_, name_;
  mutable std::array<std::optional<gpu::Pipeline>, 3> pipelines_;
};

}  // namespace slamscope::engine
