// SPDX-License-Identifier: MIT
#include "engine/gpu/device.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace slamscope::engine::gpu {

namespace {

using FeatureChain =
    vk::StructureChain<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                       vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features>;

/// A feature the engine can't do without, and where it stands in the chain.
struct Need {
  const char* name;
  vk::Bool32* flag;
};

std::array<Need, 5> needs(FeatureChain& chain) {
  return {
      {{"multiview", &chain.get<vk::PhysicalDeviceVulkan11Features>().multiview},
       {"scalarBlockLayout", &chain.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout},
       {"dynamicRendering", &chain.get<vk::PhysicalDeviceVulkan13Features>().dynamicRendering},
       {"synchronization2", &chain.get<vk::PhysicalDeviceVulkan13Features>().synchronization2},
       {"maintenance4", &chain.get<vk::PhysicalDeviceVulkan13Features>().maintenance4}}};
}

std::string missing(const vk::raii::PhysicalDevice& physical, std::uint32_t api_version) {
  if (api_version < VK_API_VERSION_1_3) return "Vulkan 1.3";
  auto chain =
      physical
          .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                        vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features>();
  std::string text;
  for (const Need& need : needs(chain)) {
    if (*need.flag == VK_FALSE) text += (text.empty() ? "" : ", ") + std::string(need.name);
  }
  return text;
}

std::string typeName(vk::PhysicalDeviceType type) {
  switch (type) {
    case vk::PhysicalDeviceType::eDiscreteGpu:
      return "discrete";
    case vk::PhysicalDeviceType::eIntegratedGpu:
      return "integrated";
    case vk::PhysicalDeviceType::eVirtualGpu:
      return "virtual";
    case vk::PhysicalDeviceType::eCpu:
      return "cpu";
    default:
      return "other";
  }
}

int speedRank(const DeviceInfo& info) {
  constexpr std::array kFastestFirst = {"discrete", "integrated", "virtual", "cpu", "other"};
  return static_cast<int>(std::ranges::find(kFastestFirst, info.type) - kFastestFirst.begin());
}

std::string versionText(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

DeviceInfo describe(const vk::raii::PhysicalDevice& physical, int index) {
  const auto chain =
      physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
  const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
  const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
  return {.index = index,
          .name = properties.deviceName.data(),
          .type = typeName(properties.deviceType),
          .api_version = versionText(properties.apiVersion),
          .driver = std::string(driver.driverName.data()) + " " + driver.driverInfo.data(),
          .lacks = missing(physical, properties.apiVersion)};
}

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::optional<std::size_t> matching(const std::vector<Candidate>& candidates,
                                    const std::string& wanted) {
  if (std::ranges::all_of(wanted, [](unsigned char c) { return std::isdigit(c) != 0; })) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (std::to_string(candidates[i].info.index) == wanted) return i;
    }
    return std::nullopt;
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (lowerCase(candidates[i].info.name).find(lowerCase(wanted)) != std::string::npos) return i;
  }
  return std::nullopt;
}

std::string listed(const std::vector<Candidate>& candidates) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    const DeviceInfo& info = candidate.info;
    text += (text.empty() ? "" : ", ") + std::to_string(info.index) + " = " + info.name;
    if (!info.lacks.empty()) text += " (lacks " + info.lacks + ")";
  }
  return text;
}

}  // namespace

std::vector<Candidate> enumerateDevices(const vk::raii::Instance& instance) {
  std::vector<Candidate> candidates;
  try {
    for (vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance)) {
      DeviceInfo info = describe(physical, static_cast<int>(candidates.size()));
      candidates.push_back({std::move(physical), std::move(info)});
    }
  } catch (const vk::InitializationFailedError&) {
    candidates.clear();  // drivers are installed, none of them starts
  }
  if (candidates.empty()) {
    throw NoVulkanDevice(
        "no Vulkan device: a driver is installed but offers none; install mesa-vulkan-drivers "
        "(software rendering)");
  }
  return candidates;
}

Candidate chooseDevice(std::vector<Candidate> candidates, const std::string& wanted) {
  std::optional<std::size_t> chosen;
  if (wanted.empty()) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!candidates[i].info.lacks.empty()) continue;
      if (!chosen || speedRank(candidates[i].info) < speedRank(candidates[*chosen].info))
        chosen = i;
    }
    if (!chosen) {
      throw NoVulkanDevice("no Vulkan device that can draw: " + listed(candidates) +
                           "; install mesa-vulkan-drivers or a newer driver of your GPU");
    }
  } else {
    chosen = matching(candidates, wanted);
    if (!chosen) {
      throw NoVulkanDevice("no Vulkan device '" + wanted + "'; there is " + listed(candidates));
    }
    const DeviceInfo& info = candidates[*chosen].info;
    if (!info.lacks.empty()) {
      throw NoVulkanDevice("Vulkan device '" + info.name + "' can't draw: it lacks " + info.lacks);
    }
  }
  return std::move(candidates[*chosen]);
}

std::uint32_t drawingFamily(const vk::raii::PhysicalDevice& physical) {
  const auto families = physical.getQueueFamilyProperties();
  constexpr auto kNeeded = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
  for (std::uint32_t i = 0; i < families.size(); ++i) {
    if ((families[i].queueFlags & kNeeded) == kNeeded) return i;
  }
  throw NoVulkanDevice("the Vulkan device has no queue that draws and computes");
}

bool hasWideAtomics(const vk::raii::PhysicalDevice& physical) {
  const auto chain =
      physical.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features>();
  return chain.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 == VK_TRUE &&
         chain.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics == VK_TRUE;
}

vk::raii::Device makeDevice(const vk::raii::PhysicalDevice& physical,
                            const DeviceRequest& request) {
  FeatureChain chain;
  for (const Need& need : needs(chain)) *need.flag = VK_TRUE;
  const vk::Bool32 wide = request.wide_atomics ? VK_TRUE : VK_FALSE;
  chain.get<vk::PhysicalDeviceFeatures2>().features.shaderInt64 = wide;
  chain.get<vk::PhysicalDeviceVulkan12Features>().shaderBufferInt64Atomics = wide;
  const float priority = 1.0F;
  const vk::DeviceQueueCreateInfo queue = {
      .queueFamilyIndex = request.family, .queueCount = 1, .pQueuePriorities = &priority};
  const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  return {physical, vk::DeviceCreateInfo{.pNext = &chain.get<vk::PhysicalDeviceFeatures2>(),
                                         .queueCreateInfoCount = 1,
                                         .pQueueCreateInfos = &queue,
                                         .enabledExtensionCount = request.present ? 1U : 0U,
                                         .ppEnabledExtensionNames = &swapchain}};
}

}  // namespace slamscope::engine::gpu
