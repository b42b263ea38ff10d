// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/gpu/upload.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/instances.hpp"
#include "engine/render/view_set.hpp"
#include "engine/scene/font_atlas.hpp"
#include "shaders/interop/glyphs.h"

namespace slamscope::engine {

/// The letters that have been drawn so far, on the device; shared by the passes that draw text.
class LetterTexture {
 public:
  explicit LetterTexture(const gpu::Core& core);

  [[nodiscard]] FontAtlas& atlas() { return atlas_; }
  /// Takes up what was added to the atlas; after all layouts of a frame, before recording.
  void update();
  void recordUpload(const vk::raii::CommandBuffer& commands) { texture_.record(commands); }
  [[nodiscard]] vk::ImageView view() const { return texture_.view(); }
  /// Grows with each new image: handles alone may come back.
  [[nodiscard]] int generation() const { return generation_; }
  [[nodiscard]] vk::Sampler sampler() const { return *sampler_; }

 private:
  FontAtlas atlas_;
  gpu::Texture texture_;
  vk::raii::Sampler sampler_;
  std::uint64_t uploaded_ = 0;
  int generation_ = 1;
};

/// Text: labels at points of the scene, or text at places of the picture. Letters are crisp (one
/// texel a pixel, whole pixel positions) with a dark halo; all halos lie under all letters.
class LetterPass {
 public:
  LetterPass(const PassSetup& setup, std::string name, std::shared_ptr<LetterTexture> texture);

  void update(std::span<const Label> labels, const ViewSet& views, int& not_drawn);
  void update(std::span<const ScreenText> texts, const ViewSet& views, int& not_drawn);
  /// After LetterTexture::update().
  void bind();
  void record(const FrameContext& context) const;

 private:
  void append(const interop::LetterGlyph& like, std::string_view text, double height_px, bool lit);
  void upload();

  std::string name_;
  std::shared_ptr<LetterTexture> texture_;
  Instances instances_;
  gpu::Pipeline pipeline_;
  std::vector<interop::LetterGlyph> halos_, letters_;
  int bound_ = 0;  // generation of the texture in the set
};

}  // namespace slamscope::engine
