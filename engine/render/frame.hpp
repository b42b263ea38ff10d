// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/core.hpp"
#include "engine/render/options.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/lens.hpp"
#include "engine/scene/picked.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

namespace gpu {
class DeviceImage;
}

/// A picture on the device and the commands that draw it; what Offscreen and the window have in
/// common, so that both give the same pixels. One frame is in flight at a time:
///
///   const auto& commands = frame.record(views, scene, options);  // waits for the frame before
///   ... copy or blit frame.colour() with `commands` (it is in gpu::copySource()) ...
///   frame.submit({acquired}, {drawn});
class Frame {
 public:
  /// views: 1 or 2. Throws std::invalid_argument for sizes that can't be.
  Frame(const gpu::Core& core, int width, int height, int views);
  ~Frame();
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  /// Lenses that the pictures are seen through from now on, one a view; none, or plain ones: the
  /// pictures as they are. Waits for the frame before. Throws std::invalid_argument for another
  /// number.
  void wear(std::span<const Lens> lenses);

  /// Uploads and records a whole frame and leaves the command buffer open. Arguments as in
  /// Offscreen::draw(), which also tells what is thrown.
  const vk::raii::CommandBuffer& record(std::span<const View> views, const Scene& scene,
                                        const RenderOptions& options);
  /// Closes the command buffer and hands it to the device.
  void submit(const std::vector<vk::Semaphore>& waits = {},
              const std::vector<vk::Semaphore>& signals = {});
  /// Until the device is done.
  void wait();

  /// What of the frame recorded last is seen at a pixel of it, before any lens; as
  /// Offscreen::pick(). Waits for the device.
  [[nodiscard]] std::optional<Picked> pick(const PickPlace& place);

  /// What is to be shown: RGBA8 UNORM, one layer a view.
  [[nodiscard]] const gpu::DeviceImage& colour() const;
  /// Of the frame last waited for; cpu_ms is that of record() alone.
  [[nodiscard]] FrameStats stats() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::engine
