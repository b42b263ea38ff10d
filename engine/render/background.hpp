// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include "engine/gpu/upload.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/view_set.hpp"

namespace slamscope::engine {

/// The cameras' pictures behind the scene, one a view. Those without a lookup map are copied into
/// the target as they are, which costs a tenth of drawing them where the device is a processor; the
/// others are undistorted by the fragment shader. Black where there is no picture and where a map
/// points outside of it.
class BackgroundPass {
 public:
  explicit BackgroundPass(const PassSetup& setup);

  void update(const ViewSet& views);
  /// Fills `target` by copying and uploads what record() draws; outside of rendering. Takes the
  /// target over from nobody, leaves it in the layout of gpu::drawnInto(). False: there was nothing
  /// to copy, so the target is still to be cleared.
  bool recordCopies(const vk::raii::CommandBuffer& commands, const gpu::DeviceImage& target);
  void record(const FrameContext& context) const;

 private:
  struct Eye {
    explicit Eye(const gpu::Core& core);
    gpu::Staging own_pixels;
    gpu::Texture picture;
    gpu::Texture map;
    std::shared_ptr<const LookupMap> uploaded_map;
    std::uint32_t kind = 0;  ///< interop::ViewData::background
  };

  void bind(std::uint32_t eye) const;
  [[nodiscard]] bool any(std::uint32_t kind) const;

  gpu::DescriptorSet set_;
  gpu::Pipeline pipeline_;
  vk::raii::Sampler sampler_;
  std::array<Eye, 2> eyes_;
};

}  // namespace slamscope::engine
