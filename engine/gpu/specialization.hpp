// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/vulkan.hpp"

namespace slamscope::engine::gpu {

/// 32-bit specialization constants 0, 1, … of a shader; must outlive the creation of the pipeline.
class Specialization {
 public:
  explicit Specialization(const std::vector<std::uint32_t>& constants) {
    for (std::uint32_t i = 0; i < constants.size(); ++i) {
      entries_.push_back(
          {i, static_cast<std::uint32_t>(i * sizeof(std::uint32_t)), sizeof(std::uint32_t)});
    }
    info_.setMapEntries(entries_).setData<std::uint32_t>(constants);
  }
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;

  [[nodiscard]] const vk::SpecializationInfo* info() const { return &info_; }

 private:
  std::vector<vk::SpecializationMapEntry> entries_;
  vk::SpecializationInfo info_;
};

}  // namespace slamscope::engine::gpu
