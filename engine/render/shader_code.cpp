// SPDX-License-Identifier: MIT
#include "engine/render/shader_code.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace slamscope::engine {

namespace {

// The one place that includes what glslangValidator wrote.
#include "arrows_frag.h"
#include "arrows_vert.h"
#include "background_frag.h"
#include "background_vert.h"
#include "cones_frag.h"
#include "cones_vert.h"
#include "ellipsoids_frag.h"
#include "ellipsoids_vert.h"
#include "group_extremes_comp.h"
#include "interop_echo_comp.h"
#include "lens_frag.h"
#include "lens_vert.h"
#include "lines_frag.h"
#include "lines_vert.h"
#include "pairs_few_comp.h"
#include "pairs_list_comp.h"
#include "pairs_place_comp.h"
#include "pairs_rank_comp.h"
#include "pairs_remember_comp.h"
#include "pairs_resolve_frag.h"
#include "pairs_splat_comp.h"
#include "pairs_tiles_vert.h"
#include "pairs_vert.h"
#include "rects_frag.h"
#include "rects_vert.h"
#include "text_frag.h"
#include "text_vert.h"

const std::array kShaders = {ShaderCode{"arrows_frag", arrows_frag},
                             ShaderCode{"arrows_vert", arrows_vert},
                             ShaderCode{"background_frag", background_frag},
                             ShaderCode{"background_vert", background_vert},
                             ShaderCode{"cones_frag", cones_frag},
                             ShaderCode{"cones_vert", cones_vert},
                             ShaderCode{"ellipsoids_frag", ellipsoids_frag},
                             ShaderCode{"ellipsoids_vert", ellipsoids_vert},
                             ShaderCode{"group_extremes_comp", group_extremes_comp},
                             ShaderCode{"interop_echo_comp", interop_echo_comp},
                             ShaderCode{"lens_frag", lens_frag},
                             ShaderCode{"lens_vert", lens_vert},
                             ShaderCode{"lines_frag", lines_frag},
                             ShaderCode{"lines_vert", lines_vert},
                             ShaderCode{"pairs_few_comp", pairs_few_comp},
                             ShaderCode{"pairs_list_comp", pairs_list_comp},
                             ShaderCode{"pairs_place_comp", pairs_place_comp},
                             ShaderCode{"pairs_rank_comp", pairs_rank_comp},
                             ShaderCode{"pairs_remember_comp", pairs_remember_comp},
                             ShaderCode{"pairs_resolve_frag", pairs_resolve_frag},
                             ShaderCode{"pairs_splat_comp", pairs_splat_comp},
                             ShaderCode{"pairs_tiles_vert", pairs_tiles_vert},
                             ShaderCode{"pairs_vert", pairs_vert},
                             ShaderCode{"rects_frag", rects_frag},
                             ShaderCode{"rects_vert", rects_vert},
                             ShaderCode{"text_frag", text_frag},
                             ShaderCode{"text_vert", text_vert}};

}  // namespace

std::span<const ShaderCode> allShaders() {
  return kShaders;
}

std::span<const std::uint32_t> shaderCode(std::string_view name) {
  for (const ShaderCode& shader : kShaders) {
    if (shader.name == name) return shader.words;
  }
  throw std::out_of_range("no shader named " + std::string(name));
}

}  // namespace slamscope::engine
