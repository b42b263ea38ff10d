// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/compute_pipeline.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/pair_data.hpp"

namespace slamscope::engine {

/// Pairs splatted by a compute shader into a visibility buffer: two 64-bit entries a pixel of each
/// view, depth above the pair's number, for the nearest ellipsoid that covers the pixel whole and
/// the nearest that has its edge there. All views in one dispatch. Then the picture is made of it,
/// each pixel shaded once, with depth, so that it stands rightly among what else is drawn; only
/// where something was splatted, tile by tile. Needs gpu::Core::wideAtomics().
class PairSplats {
 public:
  PairSplats(const PassSetup& setup, const PairData& data);

  /// Whether the device has the atomics, and buffers large enough for this frame. (48 bytes a pair
  /// and view: where storage buffers end at 128 MiB, 2,300 points in one view.)
  [[nodiscard]] static bool possible(const gpu::Core& core, const PairData& data,
                                     vk::Extent2D extent);

  /// Room for the frame; the device must not be drawing.
  void update(PairData& data, vk::Extent2D extent);
  /// Fills the visibility buffer; outside of rendering.
  void recordSplats(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
                    const PairData& data) const;
  void record(const FrameContext& context, const PairData& data) const;

 private:
  /// The pairs (i, j) in rectangles, one a work group, the nearest first.
  void sendRectangles(PairData& data);

  gpu::Buffer visibility_, large_, faces_, tiles_, rectangles_;
  std::size_t visibility_bytes_ = 0;  // that this frame uses
  std::uint32_t points_ = 0, rectangle_count_ = 0;
  std::uint32_t tile_count_ = 0;  // of a view
  gpu::ComputePipeline small_pass_, large_pass_;
  Looks resolve_;
};

}  // namespace slamscope::engine
