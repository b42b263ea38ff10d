// SPDX-License-Identifier: MIT
#include "engine/gpu/validation.hpp"

#include <utility>

namespace slamscope::engine::gpu {

void MessageLog::add(std::string message) {
  const std::scoped_lock lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> MessageLog::messages() const {
  const std::scoped_lock lock(mutex_);
  return messages_;
}

namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data,
                                       void* log) {
  static_cast<MessageLog*>(log)->add(data->pMessage);
  return VK_FALSE;
}

}  // namespace

vk::DebugUtilsMessengerCreateInfoEXT messengerInfo(MessageLog& log) {
  using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
  using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
  // "General" messages are the loader's (drivers it could not open), not about what we do.
  return {.messageSeverity = Severity::eWarning | Severity::eError,
          .messageType = Type::eValidation | Type::ePerformance,
          .pfnUserCallback = &collect,
          .pUserData = &log};
}

}  // namespace slamscope::engine::gpu
