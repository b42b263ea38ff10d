// SPDX-License-Identifier: MIT
#include "engine/render/pair_ranking.hpp"

#include <array>
#include <cstddef>

#include "engine/gpu/barrier.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kBins = 256;

}  // namespace

PairRanking::PairRanking(const PassSetup& setup, PairData& data)
    : histogram_(setup.core, kBins * sizeof(std::uint32_t),
                 vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst,
                 gpu::MemoryUse::kDevice) {
  data.bind(PairData::kHistogram, histogram_);
  const std::vector sets = {setup.frame_layout, data.set().layout()};
  const auto code = shaderCode("pairs_rank_comp");
  for (const std::uint32_t shift : {24U, 16U, 8U, 0U}) {
    rounds_.push_back({gpu::ComputePipeline(setup.core, code, sets, {shift, VK_FALSE}),
                       gpu::ComputePipeline(setup.core, code, sets, {shift, VK_TRUE})});
  }
}

void PairRanking::record(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
                         const PairData& data) const {
  const std::array sets = {frame_set, data.set().handle()};
  commands.fillBuffer(histogram_.handle(), 0, kBins * sizeof(std::uint32_t), 0);
  commands.fillBuffer(data.countsBuffer(), offsetof(interop::PairsCounts, greatest_key),
                      sizeof(std::uint32_t), 0);
  barrier(commands, gpu::copyTarget(), gpu::computed());
  for (const Round& round : rounds_) {
    round.count.bind(commands, sets);
    commands.dispatch(data.groupCount(), 1, 1);
    barrier(commands, gpu::computed(), gpu::computed());
    round.settle.bind(commands, sets);
    commands.dispatch(1, 1, 1);
    barrier(commands, gpu::computed(), gpu::computed());
  }
}

}  // namespace slamscope::engine
