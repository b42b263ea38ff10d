// SPDX-License-Identifier: MIT
#include "engine/window/presenter.hpp"

#include <stdexcept>

namespace slamscope::engine {
namespace {

vk::Extent2D extentOf(const Eigen::Vector2i& size_px) {
  return {static_cast<std::uint32_t>(size_px.x()), static_cast<std::uint32_t>(size_px.y())};
}

Eigen::Vector2i sizeOf(vk::Extent2D extent) {
  return {static_cast<int>(extent.width), static_cast<int>(extent.height)};
}

}  // namespace

Presenter::Presenter(const gpu::Core& core, const GlfwWindow& window, bool low_latency)
    : core_(&core), window_(&window), low_latency_(low_latency) {
  makeSurface();
}

void Presenter::makeSurface() {
  surface_ = {core_->instance(), window_->makeSurface(*core_->instance())};
  if (core_->physical().getSurfaceSupportKHR(core_->family(), *surface_) == VK_FALSE) {
    throw std::runtime_error("device '" + core_->info().name +
                             "' can't draw into windows of this display: choose another --device");
  }
}

void Presenter::rebuild() {
  swapchain_.reset();
  surface_ = nullptr;
  makeSurface();
}

void Presenter::fit() {
  const vk::Extent2D window = extentOf(window_->sizePx());
  if (swapchain_ && swapchain_->extent() == window) return;
  swapchain_.reset();
  if (const auto extent = gpu::Swapchain::extentOf(*core_, *surface_, window)) {
    swapchain_ = std::make_unique<gpu::Swapchain>(*core_, *surface_, *extent, low_latency_);
  }
}

bool Presenter::present(const gpu::DeviceImage& picture) {
  // A second try after the surface changed, so that the newest picture is not the one that is lost.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (window_->minimised()) return false;
    fit();
    if (!swapchain_) return false;
    box_ = letterbox(sizeOf(picture.extent()), static_cast<int>(picture.layers()),
                     sizeOf(swapchain_->extent()));
    const vk::Rect2D target = {{box_.corner_px.x(), box_.corner_px.y()}, extentOf(box_.size_px)};
    const gpu::Presented presented = swapchain_->present(picture, target);
    if (presented == gpu::Presented::kShown) return true;
    swapchain_.reset();
    if (presented == gpu::Presented::kLost) rebuild();
  }
  return true;
}

void Presenter::wait() {
  if (swapchain_) swapchain_->wait();
}

}  // namespace slamscope::engine
