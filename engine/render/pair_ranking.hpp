// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "engine/gpu/compute_pipeline.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/pair_data.hpp"

namespace slamscope::engine {

/// Finds on the device the area that PairChoice::most pairs reach: a histogram of the areas' bits,
/// eight at a time.
class PairRanking {
 public:
  PairRanking(const PassSetup& setup, PairData& data);

  void record(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
              const PairData& data) const;

 private:
  struct Round {
    gpu::ComputePipeline count, settle;
  };

  gpu::Buffer histogram_;
  std::vector<Round> rounds_;
};

}  // namespace slamscope::engine
