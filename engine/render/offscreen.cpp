// SPDX-License-Identifier: MIT
#include "engine/render/offscreen.hpp"

#include <chrono>
#include <utility>

#include "engine/gpu/readback.hpp"
#include "engine/render/frame.hpp"

namespace slamscope::engine {

struct Offscreen::Parts {
  Parts(std::shared_ptr<Gpu> the_gpu, int width, int height, int views)
      : gpu(std::move(the_gpu)), frame(gpu->core(), width, height, views), readback(gpu->core()) {}

  std::shared_ptr<Gpu> gpu;
  Frame frame;
  gpu::Readback readback;
  FrameStats stats;
  bool drawn = false;
};

Offscreen::Offscreen(std::shared_ptr<Gpu> gpu, int width, int height, int views)
    : parts_(std::make_unique<Parts>(std::move(gpu), width, height, views)) {}
Offscreen::~Offscreen() = default;

void Offscreen::wear(std::span<const Lens> lenses) {
  parts_->frame.wear(lenses);
}

std::vector<Image> Offscreen::draw(std::span<const View> views, const Scene& scene,
                                   const RenderOptions& options) {
  std::vector<Image> pictures;
  draw(views, scene, options, pictures);
  return pictures;
}

void Offscreen::draw(std::span<const View> views, const Scene& scene, const RenderOptions& options,
                     std::vector<Image>& pictures) {
  const auto start = std::chrono::steady_clock::now();
  const auto& commands = parts_->frame.record(views, scene, options);
  parts_->readback.record(commands, parts_->frame.colour());
  parts_->frame.submit();
  parts_->frame.wait();

  const vk::Extent2D extent = parts_->frame.colour().extent();
  pictures.resize(views.size());
  for (std::uint32_t i = 0; i < pictures.size(); ++i) {
    pictures[i].width = static_cast<int>(extent.width);
    pictures[i].height = static_cast<int>(extent.height);
    parts_->readback.copyLayer(i, pictures[i].rgba);
  }
  parts_->stats = parts_->frame.stats();
  parts_->drawn = true;
  parts_->stats.cpu_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::optional<Picked> Offscreen::pick(const PickPlace& place) {
  return parts_->drawn ? parts_->frame.pick(place) : std::nullopt;
}

const FrameStats& Offscreen::lastStats() const {
  return parts_->stats;
}

}  // namespace slamscope::engine
