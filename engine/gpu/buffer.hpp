// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>

#include "engine/gpu/memory.hpp"

namespace slamscope::engine::gpu {

/// Memory of the device; mapped for as long as it lives unless only the device uses it.
class Buffer {
 public:
  Buffer(const Core& core, std::size_t bytes, vk::BufferUsageFlags usage, MemoryUse use);

  /// Grows to at least `bytes` (content is lost, never shrinks). True where the handle changed:
  /// then descriptors must be written again. The device must not be using it.
  bool reserve(std::size_t bytes);

  /// For shaders that read it as a buffer of texels; of no use once reserve() was true.
  [[nodiscard]] vk::raii::BufferView texels(vk::Format format) const;

  [[nodiscard]] vk::Buffer handle() const { return *buffer_; }
  [[nodiscard]] std::size_t size() const { return bytes_; }
  /// Empty for MemoryUse::kDevice.
  [[nodiscard]] std::span<std::byte> mapped() const {
    return {mapped_, mapped_ != nullptr ? bytes_ : 0};
  }
  /// The memory as `count` values of T. Throws std::out_of_range where they don't fit.
  template <typename T>
  [[nodiscard]] std::span<T> as(std::size_t count) const {
    if (count * sizeof(T) > mapped().size())
      throw std::out_of_range("buffer is smaller than asked for");
    return {reinterpret_cast<T*>(mapped_), count};
  }

 private:
  void create();

  const Core* core_;
  std::size_t bytes_;
  vk::BufferUsageFlags usage_;
  MemoryUse use_;
  Memory memory_;
  vk::raii::Buffer buffer_ = nullptr;
  std::byte* mapped_ = nullptr;
};

}  // namespace slamscope::engine::gpu
