// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/core.hpp"

namespace slamscope::engine::gpu {

/// The device's own clock before and after what is recorded between begin() and end().
class Timestamps {
 public:
  explicit Timestamps(const Core& core);

  void begin(const vk::raii::CommandBuffer& commands) const;
  void end(const vk::raii::CommandBuffer& commands) const;
  /// Once the fence is signalled; 0 where the queue has no clock.
  [[nodiscard]] double elapsedMs() const;

 private:
  double ms_per_tick_ = 0.0;
  vk::raii::QueryPool pool_;
};

}  // namespace slamscope::engine::gpu
