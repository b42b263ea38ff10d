// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/gpu/buffer.hpp"

namespace slamscope::engine::gpu {

struct Binding {
  std::uint32_t binding = 0;
  vk::DescriptorType type = vk::DescriptorType::eStorageBuffer;
  std::uint32_t count = 1;
  vk::ShaderStageFlags stages = vk::ShaderStageFlagBits::eVertex;
};

/// One descriptor set with its layout and pool. Write only while the device is not using it.
class DescriptorSet {
 public:
  DescriptorSet(const Core& core, const std::vector<Binding>& bindings);

  void writeBuffer(std::uint32_t binding, vk::Buffer buffer) const;
  void writeTexels(std::uint32_t binding, vk::BufferView view) const;
  /// `element` of an array binding.
  void writeImage(std::uint32_t binding, std::uint32_t element, vk::ImageView view,
                  vk::Sampler sampler) const;

  [[nodiscard]] vk::DescriptorSetLayout layout() const { return *layout_; }
  [[nodiscard]] vk::DescriptorSet handle() const { return *set_; }

 private:
  [[nodiscard]] vk::DescriptorType typeOf(std::uint32_t binding) const;

  const Core* core_;
  std::vector<Binding> bindings_;
  vk::raii::DescriptorSetLayout layout_ = nullptr;
  vk::raii::DescriptorPool pool_ = nullptr;
  vk::raii::DescriptorSet set_ = nullptr;
};

}  // namespace slamscope::engine::gpu
