// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "engine/render/frame_context.hpp"
#include "engine/render/instances.hpp"
#include "engine/render/view_set.hpp"
#include "shaders/interop/glyphs.h"

namespace slamscope::engine {

/// Polylines of constant width on the picture (at most 100 px), anti-aliased, round at ends and
/// joints. They lie behind all glyphs: drawn first, without depth. Points that show less than half
/// a pixel from the last one drawn (in every view) are left out, so that long paths stay cheap.
class LinePass {
 public:
  explicit LinePass(const PassSetup& setup);

  void update(std::span<const Polyline> lines, const ViewSet& views, int& not_drawn);
  void record(const FrameContext& context) const;
  /// By instance, as Look::named numbers them.
  [[nodiscard]] std::span<const std::uint64_t> tags() const { return tags_; }

 private:
  void append(const Polyline& line, const ViewSet& views);

  Instances instances_;
  Looks looks_;
  std::vector<interop::SegmentGlyph> segments_;
  std::vector<std::uint64_t> tags_;
};

}  // namespace slamscope::engine
