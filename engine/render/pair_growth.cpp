// SPDX-License-Identifier: MIT
#include "engine/render/pair_growth.hpp"

#include <algorithm>

#include "engine/gpu/barrier.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kMostGroups = 1024;
constexpr auto kAreas =
    vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformTexelBuffer;

gpu::Buffer areasOn(const gpu::Core& core) {
  return {core, 0, kAreas, gpu::MemoryUse::kDevice};
}

std::vector<vk::DescriptorSetLayout> growthSets(const PassSetup& setup, const PairData& data) {
  return {setup.frame_layout, data.set().layout()};
}

}  // namespace

PairGrowth::PairGrowth(const PassSetup& setup, const PairData& data)
    : areas_{areasOn(setup.core), areasOn(setup.core)},
      index_then_(setup.core, 0, vk::BufferUsageFlagBits::eUniformTexelBuffer,
                  gpu::MemoryUse::kUpload),
      first_(setup.core, shaderCode("pairs_remember_comp"), growthSets(setup, data), {VK_FALSE}),
      last_(setup.core, shaderCode("pairs_remember_comp"), growthSets(setup, data), {VK_TRUE}) {}

void PairGrowth::update(PairData& data) {
  const MostBy most_by = data.choice().most_by;
  pending_ = data.points() != taken_ || most_by != most_by_;
  if (!pending_) return;
  if (most_by != most_by_) index_of_.clear();
  most_by_ = most_by;
  taken_ = data.points();
  sendIndices(*taken_);
  newer_ = 1 - newer_;
  areas_[newer_].reserve(taken_->blocks().size() * 2 * sizeof(float));
  data.bind(PairData::kIndexThen, index_then_);
  data.bind(PairData::kOldAreas, areas_[1 - newer_]);
  data.bind(PairData::kNewAreas, areas_[newer_]);
  data.bind(PairData::kThen, areas_[newer_]);
}

void PairGrowth::sendIndices(const PlanarPoints& points) {
  const auto names = points.names();
  index_then_.reserve((names.size() + 1) * sizeof(std::uint32_t));
  const auto indices = index_then_.as<std::uint32_t>(names.size() + 1);
  indices[0] = static_cast<std::uint32_t>(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = index_of_.find(names[i]);
    indices[i + 1] = found == index_of_.end() ? ~0U : found->second;
  }
  index_of_.clear();
  for (std::uint32_t i = 0; i < names.size(); ++i) index_of_[names[i]] = i;
}

void PairGrowth::record(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
                        const PairData& data) const {
  const std::array sets = {frame_set, data.set().handle()};
  (most_by_ == MostBy::last_growth ? last_ : first_).bind(commands, sets);
  const auto rows = static_cast<std::uint32_t>(taken_->count());
  commands.dispatch(std::min(rows, kMostGroups), 1, 1);
  barrier(commands, gpu::computed(), gpu::readByAll());
}

}  // namespace slamscope::engine
