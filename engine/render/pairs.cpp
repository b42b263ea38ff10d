// SPDX-License-Identifier: MIT
#include "engine/render/pairs.hpp"

#include <bit>

namespace slamscope::engine {

PairPass::PairPass(const PassSetup& setup) : setup_(setup), data_(setup.core) {}

bool PairPass::nothing() const {
  return !data_.problem().empty() || data_.pairCount() == 0;
}

bool PairPass::byGrowth() const {
  return data_.choice().most > 0 && data_.choice().most_by != MostBy::area;
}

void PairPass::update(const PairGlyphs& glyphs, const ViewSet& views) {
  data_.update(glyphs, views);
  if (nothing()) return;
  const PairWay way = views.options().pair_way;
  const bool many = data_.pairCount() >= kFewPairs;
  const auto& size = views.data().views[0].size;
  const vk::Extent2D extent(static_cast<std::uint32_t>(size[0]),
                            static_cast<std::uint32_t>(size[1]));
  splatted_ = (way == PairWay::splats || (way == PairWay::chosen && many)) &&
              PairSplats::possible(setup_.core, data_, extent);
  if (byGrowth()) {
    if (!growth_) growth_.emplace(setup_, data_);
    growth_->update(data_);
  }
  ranked_ = data_.choice().most > 0 && data_.changed();
  if (ranked_ && !ranking_) ranking_.emplace(setup_, data_);
  if (splatted_) {
    if (!splats_) splats_.emplace(setup_, data_);
    splats_->update(data_, extent);
  } else {
    if (!quads_) quads_.emplace(setup_, data_);
    quads_->update(data_);
  }
}

void PairPass::recordChoice(const vk::raii::CommandBuffer& commands,
                            vk::DescriptorSet frame_set) const {
  if (nothing()) return;
  data_.recordReset(commands);
  if (byGrowth() && growth_->pending()) growth_->record(commands, frame_set, data_);
  if (ranked_) ranking_->record(commands, frame_set, data_);
  if (splatted_) {
    splats_->recordSplats(commands, frame_set, data_);
  } else {
    quads_->recordList(commands, frame_set, data_);
  }
}

void PairPass::record(const FrameContext& context) const {
  if (nothing()) return;
  if (splatted_) {
    splats_->record(context, data_);
  } else {
    quads_->record(context, data_);
  }
}

void PairPass::recordReadback(const vk::raii::CommandBuffer& commands) const {
  if (!nothing()) data_.recordReadback(commands);
}

FrameStats::Pairs PairPass::stats() const {
  if (!data_.problem().empty()) return {.problem = data_.problem()};
  if (nothing()) return {};
  const interop::PairsCounts& counts = data_.counts();
  return {.all = data_.pairCount(),
          .chosen = counts.chosen,
          .drawn = counts.drawn,
          .not_finite = counts.not_finite,
          .greatest_growth = byGrowth() ? std::bit_cast<float>(counts.greatest_key) : 0.0F,
          .uploaded_bytes = data_.uploadedBytes(),
          .splatted = splatted_,
          .problem = {}};
}

}  // namespace slamscope::engine
