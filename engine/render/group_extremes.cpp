// SPDX-License-Identifier: MIT
#include "engine/render/group_extremes.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "engine/gpu/barrier.hpp"
#include "engine/gpu/compute_pipeline.hpp"
#include "engine/gpu/descriptors.hpp"
#include "engine/gpu/submission.hpp"
#include "engine/render/covariance_room.hpp"
#include "engine/render/shader_code.hpp"
#include "shaders/interop/groups.h"

namespace slamscope::engine {
namespace {

enum Binding : std::uint32_t { kBlocks, kMembers, kResults, kCount };

using Usage = vk::BufferUsageFlagBits;

constexpr std::uint32_t kMostWorkGroups = 4096;

std::vector<gpu::Binding> bindingsOfGroups() {
  constexpr auto kStage = vk::ShaderStageFlagBits::eCompute;
  constexpr auto kTexels = vk::DescriptorType::eUniformTexelBuffer;
  return {{.binding = kBlocks, .type = kTexels, .stages = kStage},
          {.binding = kMembers, .type = kTexels, .stages = kStage},
          {.binding = kResults, .stages = kStage},
          {.binding = kCount, .stages = kStage}};
}

/// Where each group's points begin, the end of the last, then the points group after group.
std::vector<std::uint32_t> membersOf(std::span<const std::uint32_t> groups, std::uint32_t count) {
  std::vector<std::uint32_t> members(count + 1 + groups.size(), 0);
  for (const std::uint32_t group : groups) ++members[group + 1];
  for (std::uint32_t group = 0; group < count; ++group) members[group + 1] += members[group];
  std::vector<std::uint32_t> next(members.begin(), members.begin() + count);
  for (std::uint32_t i = 0; i < groups.size(); ++i) members[count + 1 + next[groups[i]]++] = i;
  return members;
}

}  // namespace

struct GroupExtremes::Parts {
  explicit Parts(std::shared_ptr<Gpu> the_gpu)
      : gpu(std::move(the_gpu)),
        blocks(gpu->core(), 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
        members(gpu->core(), 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
        results(gpu->core(), 0, Usage::eStorageBuffer, gpu::MemoryUse::kReadback),
        count(gpu->core(), sizeof(std::uint32_t), Usage::eStorageBuffer, gpu::MemoryUse::kUpload),
        set(gpu->core(), bindingsOfGroups()),
        pipeline(gpu->core(), shaderCode("group_extremes_comp"), {set.layout()}),
        submission(gpu->core()) {}

  void send(const PlanarPointsPtr& points);
  void group(std::span<const std::uint32_t> groups, std::uint32_t group_count);
  void run(std::uint32_t pair_count);

  std::shared_ptr<Gpu> gpu;
  gpu::Buffer blocks, members, results, count;
  vk::raii::BufferView blocks_view = nullptr, members_view = nullptr;
  gpu::DescriptorSet set;
  gpu::ComputePipeline pipeline;
  PlanarPointsPtr sent;        // held, so that no other can have its address
  gpu::Submission submission;  // destroyed first: waits for the device
};

void GroupExtremes::Parts::send(const PlanarPointsPtr& points) {
  if (points == sent) return;
  const auto content = points->blocks();
  blocks.reserve(content.size_bytes());
  std::memcpy(blocks.mapped().data(), content.data(), content.size_bytes());
  blocks_view = blocks.texels(vk::Format::eR32G32B32A32Sfloat);
  set.writeTexels(kBlocks, *blocks_view);
  sent = points;
}

void GroupExtremes::Parts::group(std::span<const std::uint32_t> groups, std::uint32_t group_count) {
  const std::vector<std::uint32_t> list = membersOf(groups, group_count);
  members.reserve(list.size() * sizeof(std::uint32_t));
  std::ranges::copy(list, members.as<std::uint32_t>(list.size()).begin());
  members_view = members.texels(vk::Format::eR32Uint);
  set.writeTexels(kMembers, *members_view);
  count.as<std::uint32_t>(1)[0] = group_count;
  set.writeBuffer(kCount, count.handle());
}

void GroupExtremes::Parts::run(std::uint32_t pair_count) {
  results.reserve(pair_count * sizeof(interop::GroupPairData));
  set.writeBuffer(kResults, results.handle());
  const auto& commands = submission.begin();
  const vk::DescriptorSet handle = set.handle();
  pipeline.bind(commands, {&handle, 1});
  commands.dispatch(std::min(pair_count, kMostWorkGroups), 1, 1);
  gpu::barrierToHost(commands, vk::PipelineStageFlagBits2::eComputeShader,
                     vk::AccessFlagBits2::eShaderStorageWrite);
  submission.submit();
  submission.wait();
}

GroupExtremes::GroupExtremes(std::shared_ptr<Gpu> gpu)
    : parts_(std::make_unique<Parts>(std::move(gpu))) {}
GroupExtremes::~GroupExtremes() = default;

std::string GroupExtremes::problemWith(const PlanarPoints& points) const {
  return lackOfRoom(parts_->gpu->core(), points);
}

std::vector<GroupPair> GroupExtremes::find(const PlanarPointsPtr& points,
                                           std::span<const std::uint32_t> groups) {
  if (groups.size() != static_cast<std::size_t>(points->count())) {
    throw std::invalid_argument(std::to_string(points->count()) +
                                " points need a group each, not " + std::to_string(groups.size()));
  }
  if (const std::string problem = problemWith(*points); !problem.empty()) {
    throw std::runtime_error(problem);
  }
  const std::uint32_t group_count = groups.empty() ? 0 : *std::ranges::max_element(groups) + 1;
  if (group_count < 2) return {};
  const std::uint32_t pair_count = group_count * (group_count - 1) / 2;
  parts_->send(points);
  parts_->group(groups, group_count);
  parts_->run(pair_count);

  std::vector<GroupPair> found;
  found.reserve(pair_count);
  const auto results = parts_->results.as<const interop::GroupPairData>(pair_count);
  for (std::uint32_t b = 1; b < group_count; ++b) {
    for (std::uint32_t a = 0; a < b; ++a) {
      const interop::GroupPairData& one = results[found.size()];
      GroupPair pair{.a = a,
                     .b = b,
                     .least = {one.least_i, one.least_j},
                     .greatest = {one.greatest_i, one.greatest_j}};
      pair.mean << one.mean[0], one.mean[1], one.mean[1], one.mean[2];
      found.push_back(pair);
    }
  }
  return found;
}

}  // namespace slamscope::engine
