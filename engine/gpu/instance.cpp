// SPDX-License-Identifier: MIT
#include "engine/gpu/instance.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "engine/gpu/device_info.hpp"

namespace slamscope::engine::gpu {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

void requireValidationLayer(const vk::raii::Context& loader) {
  const auto layers = loader.enumerateInstanceLayerProperties();
  const bool found = std::ranges::any_of(layers, [](const vk::LayerProperties& layer) {
    return std::strcmp(layer.layerName, kValidationLayer) == 0;
  });
  if (!found) {
    throw std::runtime_error(
        "Vulkan validation was asked for but is not installed: install vulkan-validationlayers");
  }
}

}  // namespace

vk::raii::Context openLoader() {
  try {
    return vk::raii::Context();
  } catch (const std::runtime_error&) {
    throw NoVulkanDevice("no Vulkan loader (libvulkan.so.1): install libvulkan1");
  }
}

vk::raii::Instance makeInstance(const vk::raii::Context& loader,
                                std::span<const std::string> extensions, MessageLog* log) {
  std::vector<const char*> layer_names;
  std::vector<const char*> extension_names;
  for (const std::string& name : extensions) extension_names.push_back(name.c_str());

  const vk::ApplicationInfo application = {.pApplicationName = "slamscope",
                                           .apiVersion = VK_API_VERSION_1_3};
  vk::InstanceCreateInfo info = {.pApplicationInfo = &application};
  const auto synchronization = vk::ValidationFeatureEnableEXT::eSynchronizationValidation;
  vk::ValidationFeaturesEXT features = {.enabledValidationFeatureCount = 1,
                                        .pEnabledValidationFeatures = &synchronization};
  vk::DebugUtilsMessengerCreateInfoEXT messenger;
  if (log != nullptr) {
    requireValidationLayer(loader);
    layer_names.push_back(kValidationLayer);
    extension_names.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    messenger = messengerInfo(*log);
    features.pNext = &messenger;
    info.pNext = &features;
  }
  info.setPEnabledLayerNames(layer_names).setPEnabledExtensionNames(extension_names);
  try {
    return {loader, info};
  } catch (const vk::IncompatibleDriverError&) {
    throw NoVulkanDevice(
        "no Vulkan device: no driver is installed; install mesa-vulkan-drivers or your GPU's own "
        "driver");
  }
}

}  // namespace slamscope::engine::gpu
