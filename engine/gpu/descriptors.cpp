// SPDX-License-Identifier: MIT
#include "engine/gpu/descriptors.hpp"

#include <stdexcept>
#include <utility>

namespace slamscope::engine::gpu {

DescriptorSet::DescriptorSet(const Core& core, const std::vector<Binding>& bindings)
    : core_(&core), bindings_(bindings) {
  std::vector<vk::DescriptorSetLayoutBinding> layout_bindings;
  std::vector<vk::DescriptorPoolSize> sizes;
  for (const Binding& binding : bindings) {
    layout_bindings.push_back({.binding = binding.binding,
                               .descriptorType = binding.type,
                               .descriptorCount = binding.count,
                               .stageFlags = binding.stages});
    sizes.push_back({binding.type, binding.count});
  }
  layout_ = {core.device(), vk::DescriptorSetLayoutCreateInfo{}.setBindings(layout_bindings)};
  pool_ = {core.device(),
           vk::DescriptorPoolCreateInfo{
               .flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1}
               .setPoolSizes(sizes)};
  const vk::DescriptorSetLayout handle = *layout_;
  vk::raii::DescriptorSets sets(
      core.device(), vk::DescriptorSetAllocateInfo{.descriptorPool = *pool_}.setSetLayouts(handle));
  set_ = std::move(sets.front());
}

vk::DescriptorType DescriptorSet::typeOf(std::uint32_t binding) const {
  for (const Binding& known : bindings_) {
    if (known.binding == binding) return known.type;
  }
  throw std::invalid_argument("no binding " + std::to_string(binding) + " in this set");
}

void DescriptorSet::writeBuffer(std::uint32_t binding, vk::Buffer buffer) const {
  const vk::DescriptorBufferInfo info = {.buffer = buffer, .range = VK_WHOLE_SIZE};
  core_->device().updateDescriptorSets(
      vk::WriteDescriptorSet{
          .dstSet = *set_, .dstBinding = binding, .descriptorType = typeOf(binding)}
          .setBufferInfo(info),
      {});
}

void DescriptorSet::writeTexels(std::uint32_t binding, vk::BufferView view) const {
  core_->device().updateDescriptorSets(
      vk::WriteDescriptorSet{
          .dstSet = *set_, .dstBinding = binding, .descriptorType = typeOf(binding)}
          .setTexelBufferView(view),
      {});
}

void DescriptorSet::writeImage(std::uint32_t binding, std::uint32_t element, vk::ImageView view,
                               vk::Sampler sampler) const {
  const vk::DescriptorImageInfo info = {.sampler = sampler,
                                        .imageView = view,
                                        .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
  core_->device().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = *set_,
                                                              .dstBinding = binding,
                                                              .dstArrayElement = element,
                                                              .descriptorType = typeOf(binding)}
                                           .setImageInfo(info),
                                       {});
}

}  // namespace slamscope::engine::gpu
