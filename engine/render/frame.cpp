// SPDX-License-Identifier: MIT
#include "engine/render/frame.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

#include "engine/gpu/submission.hpp"
#include "engine/gpu/timestamps.hpp"
#include "engine/render/lens_pass.hpp"
#include "engine/render/name_picture.hpp"
#include "engine/render/renderer.hpp"

namespace slamscope::engine {

namespace {

struct Size {
  vk::Extent2D extent;
  std::uint32_t views;
};

Size checkedSize(const gpu::Core& core, int width, int height, int views) {
  const auto most = static_cast<int>(core.limits().maxImageDimension2D);
  if (width < 1 || height < 1 || width > most || height > most) {
    throw std::invalid_argument("a picture of " + std::to_string(width) + " x " +
                                std::to_string(height) + " px can't be drawn: sides go from 1 to " +
                                std::to_string(most) + " px");
  }
  if (views < 1 || views > 2) {
    throw std::invalid_argument("a frame has 1 or 2 views, not " + std::to_string(views));
  }
  return {{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)},
          static_cast<std::uint32_t>(views)};
}

}  // namespace

struct Frame::Parts {
  Parts(const gpu::Core& the_core, const Size& size)
      : core(the_core),
        colour(core,
               {.format = vk::Format::eR8G8B8A8Unorm,
                .extent = size.extent,
                .layers = size.views,
                .usage = vk::ImageUsageFlagBits::eColorAttachment |
                         vk::ImageUsageFlagBits::eTransferSrc |
                         vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eSampled,
                .readable = true}),
        depth(core, {.format = vk::Format::eD32Sfloat,
                     .extent = size.extent,
                     .layers = size.views,
                     .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment}),
        renderer(core, static_cast<int>(size.views)),
        timestamps(core),
        submission(core) {}

  const gpu::Core& core;
  gpu::DeviceImage colour, depth;
  Renderer renderer;
  std::optional<LensPass> lens;
  std::optional<NamePicture> names;  ///< from the first pick on
  gpu::Timestamps timestamps;
  FrameStats stats;
  gpu::Submission submission;  // destroyed first: waits for the device
};

Frame::Frame(const gpu::Core& core, int width, int height, int views)
    : parts_(std::make_unique<Parts>(core, checkedSize(core, width, height, views))) {}
Frame::~Frame() = default;

void Frame::wear(std::span<const Lens> lenses) {
  if (!lenses.empty() && lenses.size() != parts_->colour.layers()) {
    throw std::invalid_argument("this frame needs " + std::to_string(parts_->colour.layers()) +
                                " lenses, not " + std::to_string(lenses.size()));
  }
  wait();
  const bool plain = std::ranges::all_of(lenses, [](const Lens& lens) { return lens.plain(); });
  parts_->lens.reset();
  if (plain) return;
  parts_->lens.emplace(parts_->core, parts_->colour).wear(lenses);
}

const vk::raii::CommandBuffer& Frame::record(std::span<const View> views, const Scene& scene,
                                             const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const vk::Extent2D extent = parts_->colour.extent();
  if (views.size() != parts_->colour.layers()) {
    throw std::invalid_argument("this frame has " + std::to_string(parts_->colour.layers()) +
                                " views, not " + std::to_string(views.size()));
  }
  const ViewSet view_set(views, static_cast<int>(extent.width), static_cast<int>(extent.height),
                         options);
  wait();
  FrameStats stats;
  stats.not_drawn = parts_->renderer.update(view_set, scene);

  const vk::raii::CommandBuffer& commands = parts_->submission.begin();
  parts_->timestamps.begin(commands);
  parts_->renderer.record(commands, {.colour = parts_->colour, .depth = parts_->depth}, stats);
  if (parts_->lens) {
    parts_->lens->record(commands);
  } else {
    barrier(commands, parts_->colour, gpu::drawnInto(), gpu::copySource());
  }
  parts_->timestamps.end(commands);
  stats.cpu_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  parts_->stats = std::move(stats);
  return commands;
}

void Frame::submit(const std::vector<vk::Semaphore>& waits,
                   const std::vector<vk::Semaphore>& signals) {
  parts_->submission.submit(waits, signals);
}

void Frame::wait() {
  parts_->submission.wait();
}

std::optional<Picked> Frame::pick(const PickPlace& place) {
  if (!parts_->names) parts_->names.emplace(parts_->core, parts_->colour);
  return parts_->names->pick(parts_->submission, parts_->renderer, parts_->depth, place);
}

const gpu::DeviceImage& Frame::colour() const {
  return parts_->lens ? parts_->lens->shown() : parts_->colour;
}

FrameStats Frame::stats() const {
  FrameStats stats = parts_->stats;
  stats.gpu_ms = parts_->timestamps.elapsedMs();
  stats.pairs = parts_->renderer.pairStats();
  stats.device_bytes = parts_->core.memoryBytes();
  return stats;
}

}  // namespace slamscope::engine
