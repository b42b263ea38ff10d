// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <unordered_map>

#include "engine/gpu/compute_pipeline.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/pair_data.hpp"

namespace slamscope::engine {

/// Remembers on the device what the area of each pair was, so that pairs can be ranked by growth:
/// 8 bytes a pair, twice. Pairs are known again by their points' names.
class PairGrowth {
 public:
  explicit PairGrowth(const PassSetup& setup, const PairData& data);

  /// Takes points that are others than before; the device must not be drawing.
  void update(PairData& data);
  /// Whether update() took some that record() must go over.
  [[nodiscard]] bool pending() const { return pending_; }
  void record(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
              const PairData& data) const;

 private:
  void sendIndices(const PlanarPoints& points);

  std::array<gpu::Buffer, 2> areas_;  // old and new in turns
  gpu::Buffer index_then_;
  std::size_t newer_ = 0;
  gpu::ComputePipeline first_, last_;
  PlanarPointsPtr taken_;
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_;  // by name, of what was taken last
  MostBy most_by_ = MostBy::area;
  bool pending_ = false;
};

}  // namespace slamscope::engine
