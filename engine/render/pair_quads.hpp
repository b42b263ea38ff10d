// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gpu/compute_pipeline.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/pair_data.hpp"

namespace slamscope::engine {

/// Pairs as one ray-cast quad each: the device lists the chosen ones that are in the picture, and
/// draws as many as it found. A few are sorted, the farthest from the first eye first, and drawn at
/// once: a pixel in which an edge runs through another ellipsoid may show the order. Many are drawn
/// in the order of their numbers, first the pixels that an ellipsoid covers whole, which hide by
/// depth, then the edges over them: then the order shows at no pixel but those in which several
/// edges meet, for half as much time again.
class PairQuads {
 public:
  PairQuads(const PassSetup& setup, const PairData& data);

  /// Room for the frame; the device must not be drawing.
  void update(PairData& data);
  /// Makes the list; outside of rendering.
  void recordList(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
                  const PairData& data) const;
  void record(const FrameContext& context, const PairData& data) const;

 private:
  gpu::Buffer list_, runs_;
  gpu::ComputePipeline few_, count_, place_, write_;
  gpu::Pipeline depth_;
  Looks whole_, inside_, edges_;
};

}  // namespace slamscope::engine
