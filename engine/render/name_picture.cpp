// SPDX-License-Identifier: MIT
#include "engine/render/name_picture.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "engine/gpu/barrier.hpp"

namespace slamscope::engine {
namespace {

/// The pixels within reach that are in the picture.
vk::Rect2D areaAround(const PickPlace& place, const vk::Extent2D& extent) {
  const Eigen::Array2i size(static_cast<int>(extent.width), static_cast<int>(extent.height));
  const Eigen::Array2i low = (place.pixel.array() - place.reach_px).max(0);
  const Eigen::Array2i high = (place.pixel.array() + place.reach_px).min(size - 1);
  return {.offset = {low.x(), low.y()},
          .extent = {static_cast<std::uint32_t>(high.x() - low.x() + 1),
                     static_cast<std::uint32_t>(high.y() - low.y() + 1)}};
}

}  // namespace

NamePicture::NamePicture(const gpu::Core& core, const gpu::DeviceImage& like)
    : names_(core, {.extent = like.extent(),
                    .layers = like.layers(),
                    .usage = vk::ImageUsageFlagBits::eColorAttachment |
                             vk::ImageUsageFlagBits::eTransferSrc}),
      texels_(core, sizeof(std::uint32_t), vk::BufferUsageFlagBits::eTransferDst,
              gpu::MemoryUse::kReadback) {}

std::optional<Picked> NamePicture::pick(gpu::Submission& submission, const Renderer& renderer,
                                        const gpu::DeviceImage& depth, const PickPlace& place) {
  const vk::Extent2D whole = names_.extent();
  if (place.view >= names_.layers()) {
    throw std::invalid_argument("view " + std::to_string(place.view) + " was not drawn");
  }
  const bool inside = (place.pixel.array() >= 0).all() &&
                      place.pixel.x() < static_cast<int>(whole.width) &&
                      place.pixel.y() < static_cast<int>(whole.height);
  if (!inside) return std::nullopt;
  const vk::Rect2D area = areaAround(place, whole);
  const std::size_t count = std::size_t{area.extent.width} * area.extent.height;
  texels_.reserve(count * sizeof(std::uint32_t));

  const vk::raii::CommandBuffer& commands = submission.begin();
  renderer.recordNames(commands, {.colour = names_, .depth = depth}, area);
  barrier(commands, names_, gpu::drawnInto(), gpu::copySource());
  commands.copyImageToBuffer(
      names_.handle(), vk::ImageLayout::eTransferSrcOptimal, texels_.handle(),
      vk::BufferImageCopy{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, place.view, 1},
                          .imageOffset = {area.offset.x, area.offset.y, 0},
                          .imageExtent = {area.extent.width, area.extent.height, 1}});
  gpu::barrierToHost(commands, vk::PipelineStageFlagBits2::eTransfer,
                     vk::AccessFlagBits2::eTransferWrite);
  submission.submit();
  submission.wait();

  std::optional<Picked> nearest;
  int least = 0;
  const auto texels = texels_.as<const std::uint32_t>(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto width = static_cast<std::size_t>(area.extent.width);
    const Eigen::Vector2i pixel(area.offset.x + static_cast<int>(k % width),
                                area.offset.y + static_cast<int>(k / width));
    const int distance = (pixel - place.pixel).squaredNorm();
    if (texels[k] == 0 || (nearest && distance >= least)) continue;
    nearest = renderer.named(texels[k]);
    if (!nearest) continue;
    nearest->pixel = pixel;
    least = distance;
  }
  return nearest;
}

}  // namespace slamscope::engine
