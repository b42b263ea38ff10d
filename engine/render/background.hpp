// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "engine/gpu/upload.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/view_set.hpp"

namespace slamscope::engine {

/// The cameras' pictures behind the scene, one a view; lens distortion is undone on the way by the
/// views' lookup maps. Black where there is no picture and where a map points outside of it.
class BackgroundPass {
 public:
  explicit BackgroundPass(const PassSetup& setup);

  void update(const ViewSet& views);
  /// Copies to the device; outside of rendering.
  void recordUpload(const vk::raii::CommandBuffer& commands);
  void record(const FrameContext& context) const;

 private:
  struct Eye {
    explicit Eye(const gpu::Core& core);
    gpu::Texture picture;
    gpu::Texture map;
    std::shared_ptr<const LookupMap> uploaded_map;
  };

  void bind(std::uint32_t eye) const;

  gpu::DescriptorSet set_;
  PassSetup setup_;
  std::array<std::optional<gpu::Pipeline>, 4> pipelines_;  ///< by kinds_, made when first needed
  vk::raii::Sampler sampler_;
  std::array<Eye, 2> eyes_;
  std::uint32_t kinds_ = 0;  ///< of the views' pictures: 1 for some copied, 2 for some mapped
};

}  // namespace slamscope::engine
