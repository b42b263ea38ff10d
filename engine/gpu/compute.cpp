// SPDX-License-Identifier: MIT
#include "engine/gpu/compute.hpp"

#include <algorithm>

#include "engine/gpu/barrier.hpp"
#include "engine/gpu/compute_pipeline.hpp"
#include "engine/gpu/descriptors.hpp"
#include "engine/gpu/submission.hpp"

namespace slamscope::engine::gpu {

std::vector<std::byte> runCompute(const Gpu& gpu, std::span<const std::uint32_t> code,
                                  std::span<const std::byte> input, std::size_t output_bytes,
                                  std::uint32_t groups) {
  const Core& core = gpu.core();
  constexpr auto kStage = vk::ShaderStageFlagBits::eCompute;
  const Buffer in(core, input.size(), vk::BufferUsageFlagBits::eStorageBuffer, MemoryUse::kUpload);
  const Buffer out(core, output_bytes, vk::BufferUsageFlagBits::eStorageBuffer,
                   MemoryUse::kReadback);
  std::ranges::copy(input, in.mapped().begin());
  const DescriptorSet set(core,
                          {{.binding = 0, .stages = kStage}, {.binding = 1, .stages = kStage}});
  set.writeBuffer(0, in.handle());
  set.writeBuffer(1, out.handle());

  const ComputePipeline pipeline(core, code, {set.layout()});
  Submission submission(core);
  const auto& commands = submission.begin();
  const vk::DescriptorSet handle = set.handle();
  pipeline.bind(commands, {&handle, 1});
  commands.dispatch(groups, 1, 1);
  barrierToHost(commands, vk::PipelineStageFlagBits2::eComputeShader,
                vk::AccessFlagBits2::eShaderStorageWrite);
  submission.submit();
  submission.wait();
  const auto bytes = out.mapped().first(output_bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace slamscope::engine::gpu
