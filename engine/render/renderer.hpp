// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "engine/render/arrows.hpp"
#include "engine/render/background.hpp"
#include "engine/render/cones.hpp"
#include "engine/render/ellipsoids.hpp"
#include "engine/render/letters.hpp"
#include "engine/render/lines.hpp"
#include "engine/render/pairs.hpp"
#include "engine/render/rects.hpp"

namespace slamscope::engine {

/// Where to draw: one layer a view, of the same extent.
struct RenderTarget {
  const gpu::DeviceImage& colour;
  const gpu::DeviceImage& depth;
};

/// The passes, once, in the order they are drawn.
class Renderer {
 public:
  /// views: 1 or 2. Formats as in gpu::PipelineInfo.
  Renderer(const gpu::Core& core, int views);

  /// Takes the frame over to memory that the device sees, which must not be drawing. Returns the
  /// number of glyphs left out because of numbers that are not finite.
  int update(const ViewSet& views, const Scene& scene);
  /// Records uploads and the drawing. What the target held is lost; its images are left in the
  /// layouts of gpu::drawnInto() and gpu::depthTested().
  void record(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
              FrameStats& stats);
  /// Draws once more what was drawn last, as names (common/named.glsl) and no larger than
  /// `area`; the target's images are left as by record().
  void recordNames(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                   const vk::Rect2D& area) const;
  /// What a texel of that stands for; nothing where nothing is.
  [[nodiscard]] std::optional<Picked> named(std::uint32_t texel) const;
  /// Of the frame last waited for.
  [[nodiscard]] FrameStats::Pairs pairStats() const;

 private:
  void begin(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
             const vk::Rect2D& area, vk::AttachmentLoadOp load,
             const vk::ClearColorValue& clear) const;

  gpu::Buffer frame_buffer_;
  gpu::DescriptorSet frame_set_;
  PassSetup setup_;
  bool lit_ = true;

  BackgroundPass background_;
  LinePass lines_;
  ArrowPass arrows_;
  ConePass cones_;
  std::optional<PairPass> pairs_;  ///< from the first scene on that has some
  bool some_pairs_ = false;
  EllipsoidPass ellipsoids_;
  std::shared_ptr<LetterTexture> letter_texture_;
  LetterPass labels_;
  RectPass rects_;
  LetterPass texts_;
};

}  // namespace slamscope::engine
