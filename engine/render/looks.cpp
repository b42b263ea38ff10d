// SPDX-License-Identifier: MIT
#include "engine/render/looks.hpp"

#include <utility>

namespace slamscope::engine {

Looks::Looks(const gpu::Core& core, gpu::PipelineInfo info, std::uint32_t part, Picked::Kind kind)
    : core_(&core), info_(std::move(info)), part_(part), name_(nameOf(kind)) {}

const gpu::Pipeline& Looks::operator[](Look look) const {
  std::optional<gpu::Pipeline>& pipeline = pipelines_[static_cast<std::size_t>(look)];
  if (!pipeline) {
    const bool named = look == Look::named;
    gpu::PipelineInfo info = info_;
    info.blend = info_.blend && !named;
    info.depth_write = info_.depth_write || (named && info_.depth_test);
    info.constants = {look == Look::lit ? 1U : 0U, part_, named ? name_ : 0U};
    pipeline.emplace(*core_, info);
  }
  return *pipeline;
}

}  // namespace slamscope::engine
