// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "engine/gpu/vulkan.hpp"

namespace slamscope::engine::gpu {

/// Collects what the validation layer has to say; may be called from any thread.
class MessageLog {
 public:
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> messages() const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

/// Sends warnings and errors to `log`, which must outlive the messenger.
[[nodiscard]] vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(MessageLog& log);

}  // namespace slamscope::engine::gpu
