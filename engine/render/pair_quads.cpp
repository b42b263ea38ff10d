// SPDX-License-Identifier: MIT
#include "engine/render/pair_quads.hpp"

#include <cstddef>

#include "engine/gpu/barrier.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kRun = 64;  // pairs a lane, as in pairs_list.comp and pairs_place.comp
constexpr std::uint32_t kLanes = 64;

enum Part : std::uint32_t { kWhole = 0, kInside = 1, kEdges = 2 };  // as in ellipsoids.frag

std::vector<vk::DescriptorSetLayout> pairQuadSets(const PassSetup& setup, const PairData& data) {
  return {setup.frame_layout, data.set().layout()};
}

gpu::PipelineInfo pairQuadInfo(const PassSetup& setup, const PairData& data, Part part) {
  return {.vertex = shaderCode("pairs_vert"),
          .fragment = shaderCode("ellipsoids_frag"),
          .sets = pairQuadSets(setup, data),
          .view_mask = setup.view_mask,
          .depth_test = true,
          .depth_write = part != kEdges};
}

std::uint32_t runsOf(const PairData& data) {
  return (data.pairCount() + kRun - 1) / kRun;
}

gpu::PipelineInfo depthOnly(gpu::PipelineInfo info) {
  info.colour_write = false;
  info.constants = {VK_FALSE, kInside};
  return info;
}

}  // namespace

PairQuads::PairQuads(const PassSetup& setup, const PairData& data)
    : list_(setup.core, 0, vk::BufferUsageFlagBits::eStorageBuffer, gpu::MemoryUse::kDevice),
      runs_(setup.core, 0, vk::BufferUsageFlagBits::eStorageBuffer, gpu::MemoryUse::kDevice),
      few_(setup.core, shaderCode("pairs_few_comp"), pairQuadSets(setup, data)),
      count_(setup.core, shaderCode("pairs_list_comp"), pairQuadSets(setup, data), {VK_FALSE}),
      place_(setup.core, shaderCode("pairs_place_comp"), pairQuadSets(setup, data)),
      write_(setup.core, shaderCode("pairs_list_comp"), pairQuadSets(setup, data), {VK_TRUE}),
      depth_(setup.core, depthOnly(pairQuadInfo(setup, data, kInside))),
      whole_(setup.core, pairQuadInfo(setup, data, kWhole), kWhole, Picked::Kind::pair),
      inside_(setup.core, pairQuadInfo(setup, data, kInside), kInside, Picked::Kind::pair),
      edges_(setup.core, pairQuadInfo(setup, data, kEdges), kEdges, Picked::Kind::pair) {}

void PairQuads::update(PairData& data) {
  list_.reserve(data.pairCount() * sizeof(std::uint32_t));
  runs_.reserve(runsOf(data) * sizeof(std::uint32_t));
  data.bind(PairData::kList, list_);
  data.bind(PairData::kRuns, runs_);
}

void PairQuads::recordList(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
                           const PairData& data) const {
  const std::array sets = {frame_set, data.set().handle()};
  if (data.pairCount() < kFewPairs) {
    few_.bind(commands, sets);
    commands.dispatch(1, 1, 1);
    barrier(commands, gpu::computed(), gpu::readByAll());
    return;
  }
  const std::uint32_t groups = (runsOf(data) + kLanes - 1) / kLanes;
  count_.bind(commands, sets);
  commands.dispatch(groups, 1, 1);
  barrier(commands, gpu::computed(), gpu::computed());
  place_.bind(commands, sets);
  commands.dispatch(1, 1, 1);
  barrier(commands, gpu::computed(), gpu::computed());
  write_.bind(commands, sets);
  commands.dispatch(groups, 1, 1);
  barrier(commands, gpu::computed(), gpu::readByAll());
}

void PairQuads::record(const FrameContext& context, const PairData& data) const {
  const auto draw = [&](const gpu::Pipeline& pipeline) {
    context.drawIndirect("pairs", pipeline, data.set().handle(), data.countsBuffer(),
                         offsetof(interop::PairsCounts, vertices));
  };
  // Translucent ones fade as one layer: what is nearest must be known before anything is blended.
  if (data.data().colour[3] < 1.0F) draw(depth_);
  if (data.pairCount() < kFewPairs) {
    draw(whole_[context.look]);
  } else {
    draw(inside_[context.look]);
    draw(edges_[context.look]);
  }
}

}  // namespace slamscope::engine
