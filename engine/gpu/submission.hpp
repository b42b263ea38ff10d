// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/gpu/core.hpp"

namespace slamscope::engine::gpu {

/// One command buffer and its fence: recorded, submitted, waited for, recorded again.
class Submission {
 public:
  explicit Submission(const Core& core);
  /// Waits for the device.
  ~Submission();
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;

  /// Waits for what was submitted before, then opens the command buffer.
  const vk::raii::CommandBuffer& begin();
  /// Closes and submits. `waits` hold back colour output and copies only, `signals` come after all.
  void submit(const std::vector<vk::Semaphore>& waits = {},
              const std::vector<vk::Semaphore>& signals = {});
  /// Until the device has done what was submitted.
  void wait();

  [[nodiscard]] const vk::raii::CommandBuffer& commands() const { return commands_; }

 private:
  const Core* core_;
  vk::raii::CommandPool pool_;
  vk::raii::CommandBuffer commands_ = nullptr;
  vk::raii::Fence fence_;
  bool pending_ = false;
};

}  // namespace slamscope::engine::gpu
