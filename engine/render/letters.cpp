// SPDX-License-Identifier: MIT
#include "engine/render/letters.hpp"

#include <cmath>
#include <utility>

#include "engine/render/shader_code.hpp"
#include "engine/scene/text_layout.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kAtlas = 1;  // as in text.frag
constexpr float kHaloOpacity = 0.8F;

gpu::Binding atlasBinding() {
  return {.binding = kAtlas,
          .type = vk::DescriptorType::eCombinedImageSampler,
          .stages = vk::ShaderStageFlagBits::eFragment};
}

}  // namespace

LetterTexture::LetterTexture(const gpu::Core& core)
    : texture_(core, vk::Format::eR8G8Unorm, 2), sampler_(core.device(), vk::SamplerCreateInfo{}) {}

void LetterTexture::update() {
  if (atlas_.revision() == uploaded_) return;
  uploaded_ = atlas_.revision();
  const bool renewed = texture_.write(
      {static_cast<std::uint32_t>(atlas_.width()), static_cast<std::uint32_t>(atlas_.height())},
      std::as_bytes(atlas_.pixels()));
  if (renewed) ++generation_;
}

LetterPass::LetterPass(const PassSetup& setup, std::string name,
                       std::shared_ptr<LetterTexture> texture)
    : name_(std::move(name)),
      texture_(std::move(texture)),
      instances_(setup.core, {atlasBinding()}),
      pipeline_(setup.core, {.vertex = shaderCode("text_vert"),
                             .fragment = shaderCode("text_frag"),
                             .sets = {setup.frame_layout, instances_.set().layout()},
                             .view_mask = setup.view_mask}) {}

void LetterPass::append(const interop::LetterGlyph& like, std::string_view text, double height_px,
                        bool lit) {
  for (const GlyphQuad& quad : layoutText(texture_->atlas(), text, height_px)) {
    interop::LetterGlyph letter = like;
    letter.min_px = {quad.min_px.x(), quad.min_px.y()};
    letter.max_px = {quad.max_px.x(), quad.max_px.y()};
    letter.uv = {quad.min_uv.x(), quad.min_uv.y()};
    letters_.push_back(letter);
    if (!lit) continue;
    letter.colour = {0.0F, 0.0F, 0.0F, kHaloOpacity * like.colour[3]};
    letter.halo = 1;
    halos_.push_back(letter);
  }
}

void LetterPass::upload() {
  halos_.insert(halos_.end(), letters_.begin(), letters_.end());
  instances_.upload<interop::LetterGlyph>(halos_);
  halos_.clear();
  letters_.clear();
}

void LetterPass::update(std::span<const Label> labels, const ViewSet& views, int& not_drawn) {
  for (const Label& label : labels) {
    if (!label.anchor.allFinite() || !label.offset_px.allFinite() ||
        !std::isfinite(label.height_px)) {
      ++not_drawn;
      continue;
    }
    const TextExtent extent = measureText(texture_->atlas(), label.text, label.height_px);
    const Eigen::Vector2d half_size(0.5 * extent.width_px, 0.5 * extent.height_px);
    interop::LetterGlyph like = {};
    like.anchor = views.point(label.anchor);
    like.offset_px = toVec2(label.offset_px - half_size);
    like.colour = views.colour(label.colour);
    like.anchored = 1;
    append(like, label.text, label.height_px, views.options().lit);
  }
  upload();
}

void LetterPass::update(std::span<const ScreenText> texts, const ViewSet& views, int& not_drawn) {
  for (const ScreenText& text : texts) {
    if (!text.position_px.allFinite() || !std::isfinite(text.height_px)) {
      ++not_drawn;
      continue;
    }
    interop::LetterGlyph like = {};
    like.offset_px = toVec2(text.position_px);
    like.colour = toVec4(text.colour);
    append(like, text.text, text.height_px, views.options().lit);
  }
  upload();
}

void LetterPass::bind() {
  if (bound_ == texture_->generation()) return;
  bound_ = texture_->generation();
  instances_.set().writeImage(kAtlas, 0, texture_->view(), texture_->sampler());
}

void LetterPass::record(const FrameContext& context) const {
  context.draw(name_, pipeline_, instances_.set().handle(), 4, instances_.count());
}

}  // namespace slamscope::engine
