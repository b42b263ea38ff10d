// SPDX-License-Identifier: MIT
#include "engine/gpu/swapchain.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/gpu/barrier.hpp"

namespace slamscope::engine::gpu {
namespace {

constexpr std::uint64_t kPatienceNs = 1'000'000'000;

// Bytes are shown as they are (no sRGB conversion), as in the files.
vk::SurfaceFormatKHR chooseFormat(const std::vector<vk::SurfaceFormatKHR>& offered) {
  for (const vk::Format wanted : {vk::Format::eB8G8R8A8Unorm, vk::Format::eR8G8B8A8Unorm}) {
    for (const vk::SurfaceFormatKHR& format : offered) {
      if (format.format == wanted && format.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear) {
        return format;
      }
    }
  }
  throw std::runtime_error("the display offers no 8-bit format without conversion of colours");
}

vk::PresentModeKHR chooseMode(const std::vector<vk::PresentModeKHR>& offered, bool low_latency) {
  const auto mailbox = std::ranges::find(offered, vk::PresentModeKHR::eMailbox);
  return low_latency && mailbox != offered.end() ? *mailbox : vk::PresentModeKHR::eFifo;
}

vk::CompositeAlphaFlagBitsKHR chooseAlpha(vk::CompositeAlphaFlagsKHR offered) {
  for (const auto wanted :
       {vk::CompositeAlphaFlagBitsKHR::eOpaque, vk::CompositeAlphaFlagBitsKHR::eInherit}) {
    if (offered & wanted) return wanted;
  }
  return vk::CompositeAlphaFlagBitsKHR::ePreMultiplied;
}

vk::SwapchainCreateInfoKHR describe(const Core& core, vk::SurfaceKHR surface, vk::Extent2D extent,
                                    bool low_latency) {
  const auto& physical = core.physical();
  const auto able = physical.getSurfaceCapabilitiesKHR(surface);
  if (!(able.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst)) {
    throw std::runtime_error("the display's surface can't be copied into");
  }
  const auto format = chooseFormat(physical.getSurfaceFormatsKHR(surface));
  std::uint32_t count = able.minImageCount + 1;
  if (able.maxImageCount > 0) count = std::min(count, able.maxImageCount);
  return {.surface = surface,
          .minImageCount = count,
          .imageFormat = format.format,
          .imageColorSpace = format.colorSpace,
          .imageExtent = extent,
          .imageArrayLayers = 1,
          .imageUsage = vk::ImageUsageFlagBits::eTransferDst,
          .imageSharingMode = vk::SharingMode::eExclusive,
          .preTransform = able.currentTransform,
          .compositeAlpha = chooseAlpha(able.supportedCompositeAlpha),
          .presentMode = chooseMode(physical.getSurfacePresentModesKHR(surface), low_latency),
          .clipped = VK_TRUE};
}

vk::ImageBlit blitOf(const DeviceImage& picture, vk::Rect2D target, std::uint32_t layer) {
  const auto width = static_cast<std::int32_t>(target.extent.width);
  const auto layers = static_cast<std::int32_t>(picture.layers());
  const std::int32_t left = target.offset.x + width * static_cast<std::int32_t>(layer) / layers;
  const std::int32_t right =
      target.offset.x + width * (static_cast<std::int32_t>(layer) + 1) / layers;
  const auto bottom = target.offset.y + static_cast<std::int32_t>(target.extent.height);
  vk::ImageBlit blit;
  blit.srcSubresource = {vk::ImageAspectFlagBits::eColor, 0, layer, 1};
  blit.srcOffsets[1] = vk::Offset3D{static_cast<std::int32_t>(picture.extent().width),
                                    static_cast<std::int32_t>(picture.extent().height), 1};
  blit.dstSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1};
  blit.dstOffsets[0] = vk::Offset3D{left, target.offset.y, 0};
  blit.dstOffsets[1] = vk::Offset3D{right, bottom, 1};
  return blit;
}

}  // namespace

Swapchain::Swapchain(const Core& core, vk::SurfaceKHR surface, vk::Extent2D extent,
                     bool low_latency)
    : core_(&core),
      extent_(extent),
      chain_(core.device(), describe(core, surface, extent, low_latency)),
      acquired_(core.device(), vk::SemaphoreCreateInfo{}),
      submission_(core) {
  for (const VkImage image : chain_.getImages()) images_.emplace_back(image);
  for (std::size_t i = 0; i < images_.size(); ++i) {
    drawn_.emplace_back(core.device(), vk::SemaphoreCreateInfo{});
  }
}

Swapchain::~Swapchain() {
  try {
    core_->queue().waitIdle();
  } catch (const std::exception&) {
    // A lost device has nothing left to wait for.
  }
}

std::optional<vk::Extent2D> Swapchain::extentOf(const Core& core, vk::SurfaceKHR surface,
                                                vk::Extent2D window) {
  const auto able = core.physical().getSurfaceCapabilitiesKHR(surface);
  vk::Extent2D extent = able.currentExtent;
  if (extent.width == UINT32_MAX) {
    extent.width = std::min(window.width, able.maxImageExtent.width);
    extent.height = std::min(window.height, able.maxImageExtent.height);
  }
  if (extent.width == 0 || extent.height == 0) return std::nullopt;
  return extent;
}

Presented Swapchain::present(const DeviceImage& picture, vk::Rect2D target) {
  try {
    const auto index = acquire();
    if (!index) return Presented::kShown;
    record(picture, target, images_[*index]);
    submission_.submit({*acquired_}, {*drawn_[*index]});
    const vk::Semaphore drawn = *drawn_[*index];
    const vk::SwapchainKHR chain = *chain_;
    const vk::PresentInfoKHR info = {.waitSemaphoreCount = 1,
                                     .pWaitSemaphores = &drawn,
                                     .swapchainCount = 1,
                                     .pSwapchains = &chain,
                                     .pImageIndices = &*index};
    stale_ = core_->queue().presentKHR(info) == vk::Result::eSuboptimalKHR || stale_;
    return stale_ ? Presented::kStale : Presented::kShown;
  } catch (const vk::OutOfDateKHRError&) {
    return Presented::kStale;
  } catch (const vk::SurfaceLostKHRError&) {
    return Presented::kLost;
  }
}

std::optional<std::uint32_t> Swapchain::acquire() {
  submission_.wait();  // the semaphore is free when what waited for it is done
  const auto [result, index] = chain_.acquireNextImage(kPatienceNs, *acquired_);
  stale_ = stale_ || result == vk::Result::eSuboptimalKHR;
  if (result == vk::Result::eTimeout || result == vk::Result::eNotReady) return std::nullopt;
  return index;
}

void Swapchain::record(const DeviceImage& picture, vk::Rect2D target, vk::Image image) {
  const auto& commands = submission_.begin();
  constexpr auto kColour = vk::ImageAspectFlagBits::eColor;
  barrier(commands, image, kColour, unused(), copyTarget());
  if (target.extent != extent_) {
    const vk::ImageSubresourceRange whole = {kColour, 0, 1, 0, 1};
    const vk::ClearColorValue black(std::array<float, 4>{0.0F, 0.0F, 0.0F, 1.0F});
    commands.clearColorImage(image, vk::ImageLayout::eTransferDstOptimal, black, whole);
    barrier(commands, image, kColour, copyTarget(), copyTarget());
  }
  const bool exact = target.extent.width == picture.extent().width * picture.layers() &&
                     target.extent.height == picture.extent().height;
  for (std::uint32_t layer = 0; layer < picture.layers(); ++layer) {
    commands.blitImage(picture.handle(), vk::ImageLayout::eTransferSrcOptimal, image,
                       vk::ImageLayout::eTransferDstOptimal, blitOf(picture, target, layer),
                       exact ? vk::Filter::eNearest : vk::Filter::eLinear);
  }
  barrier(commands, image, kColour, copyTarget(), presented());
}

}  // namespace slamscope::engine::gpu
