// SPDX-License-Identifier: MIT
#include "engine/gpu/timestamps.hpp"

#include <cstdint>

namespace slamscope::engine::gpu {

Timestamps::Timestamps(const Core& core)
    : pool_(core.device(),
            vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 2}) {
  const auto families = core.physical().getQueueFamilyProperties();
  if (families[core.family()].timestampValidBits > 0) {
    ms_per_tick_ = static_cast<double>(core.limits().timestampPeriod) * 1e-6;
  }
}

void Timestamps::begin(const vk::raii::CommandBuffer& commands) const {
  if (ms_per_tick_ == 0.0) return;
  commands.resetQueryPool(*pool_, 0, 2);
  commands.writeTimestamp2(vk::PipelineStageFlagBits2::eTopOfPipe, *pool_, 0);
}

void Timestamps::end(const vk::raii::CommandBuffer& commands) const {
  if (ms_per_tick_ == 0.0) return;
  commands.writeTimestamp2(vk::PipelineStageFlagBits2::eBottomOfPipe, *pool_, 1);
}

double Timestamps::elapsedMs() const {
  if (ms_per_tick_ == 0.0) return 0.0;
  const auto [result, ticks] = pool_.getResults<std::uint64_t>(
      0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64);
  if (result != vk::Result::eSuccess) return 0.0;
  return static_cast<double>(ticks[1] - ticks[0]) * ms_per_tick_;
}

}  // namespace slamscope::engine::gpu
