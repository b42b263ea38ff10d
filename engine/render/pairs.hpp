// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/render/pair_data.hpp"
#include "engine/render/pair_growth.hpp"
#include "engine/render/pair_quads.hpp"
#include "engine/render/pair_ranking.hpp"
#include "engine/render/pair_splats.hpp"

namespace slamscope::engine {

/// PairGlyphs: chosen on the device, drawn by one of two ways (PairWay).
class PairPass {
 public:
  explicit PairPass(const PassSetup& setup);

  void update(const PairGlyphs& glyphs, const ViewSet& views);
  /// All that is computed before anything is drawn; outside of rendering.
  void recordChoice(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set) const;
  void record(const FrameContext& context) const;
  void recordReadback(const vk::raii::CommandBuffer& commands) const;
  [[nodiscard]] const PairData& data() const { return data_; }
  /// Of the frame last waited for.
  [[nodiscard]] FrameStats::Pairs stats() const;

 private:
  [[nodiscard]] bool nothing() const;
  [[nodiscard]] bool byGrowth() const;

  PassSetup setup_;
  PairData data_;
  std::optional<PairGrowth> growth_;  ///< from the first ranking by growth on
  std::optional<PairRanking> ranking_;
  std::optional<PairQuads> quads_;
  std::optional<PairSplats> splats_;
  bool splatted_ = false;
  bool ranked_ = false;
};

}  // namespace slamscope::engine
