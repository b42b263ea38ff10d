// SPDX-License-Identifier: MIT
#include "engine/render/renderer.hpp"

#include <tuple>

namespace slamscope::engine {

Renderer::Renderer(const gpu::Core& core, int views)
    : frame_buffer_(core, sizeof(interop::FrameData), vk::BufferUsageFlagBits::eUniformBuffer,
                    gpu::MemoryUse::kUpload),
      frame_set_(core,
                 {{.binding = 0,
                   .type = vk::DescriptorType::eUniformBuffer,
                   .stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment |
                             vk::ShaderStageFlagBits::eCompute}}),
      setup_{.core = core,
             .frame_layout = frame_set_.layout(),
             .view_mask = (1U << static_cast<unsigned>(views)) - 1U},
      background_(setup_),
      lines_(setup_),
      arrows_(setup_),
      cones_(setup_),
      ellipsoids_(setup_),
      letter_texture_(std::make_shared<LetterTexture>(core)),
      labels_(setup_, "labels", letter_texture_),
      rects_(setup_),
      texts_(setup_, "texts", letter_texture_) {
  frame_set_.writeBuffer(0, frame_buffer_.handle());
}

int Renderer::update(const ViewSet& views, const Scene& scene) {
  int not_drawn = 0;
  frame_buffer_.as<interop::FrameData>(1)[0] = views.data();
  lit_ = views.options().lit;
  background_.update(views);
  lines_.update(scene.lines, views, not_drawn);
  arrows_.update(scene.arrows, views, not_drawn);
  cones_.update(scene.cones, views, not_drawn);
  some_pairs_ = scene.pairs && scene.pairs->points;
  if (some_pairs_) {
    if (!pairs_) pairs_.emplace(setup_);
    pairs_->update(*scene.pairs, views);
  }
  ellipsoids_.update(scene.ellipsoids, views, not_drawn);
  labels_.update(scene.labels, views, not_drawn);
  rects_.update(scene.rects, not_drawn);
  texts_.update(scene.texts, views, not_drawn);
  letter_texture_->update();
  labels_.bind();
  texts_.bind();
  return not_drawn;
}

void Renderer::begin(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                     const vk::Rect2D& area, vk::AttachmentLoadOp load,
                     const vk::ClearColorValue& clear) const {
  const vk::RenderingAttachmentInfo colour = {
      .imageView = target.colour.view(),
      .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
      .loadOp = load,
      .storeOp = vk::AttachmentStoreOp::eStore,
      .clearValue = clear};
  const vk::RenderingAttachmentInfo depth = {
      .imageView = target.depth.view(),
      .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eDontCare,
      .clearValue = vk::ClearDepthStencilValue{.depth = 0.0F}};  // reversed: infinitely far
  const vk::Extent2D extent = target.colour.extent();
  commands.beginRendering({.renderArea = area,
                           .layerCount = 1,
                           .viewMask = setup_.view_mask,
                           .colorAttachmentCount = 1,
                           .pColorAttachments = &colour,
                           .pDepthAttachment = &depth});
  commands.setViewport(0,
                       vk::Viewport{.x = -kBorderPx,
                                    .y = -kBorderPx,
                                    .width = static_cast<float>(extent.width) + 2.0F * kBorderPx,
                                    .height = static_cast<float>(extent.height) + 2.0F * kBorderPx,
                                    .maxDepth = 1.0F});
  commands.setScissor(0, area);
}

void Renderer::record(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                      FrameStats& stats) {
  const bool background_stands = background_.recordCopies(commands, target.colour);
  barrier(commands, target.depth, gpu::unused(), gpu::depthTested());
  letter_texture_->recordUpload(commands);
  if (some_pairs_) pairs_->recordChoice(commands, frame_set_.handle());

  begin(commands, target, {.extent = target.colour.extent()},
        background_stands ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
        std::array{0.0F, 0.0F, 0.0F, 1.0F});
  const FrameContext context = {commands, frame_set_.handle(), lit_ ? Look::lit : Look::flat,
                                stats};
  background_.record(context);
  lines_.record(context);
  arrows_.record(context);
  cones_.recordInside(context);
  if (some_pairs_) pairs_->record(context);
  ellipsoids_.record(context);
  cones_.recordEdges(context);
  labels_.record(context);
  rects_.record(context);
  texts_.record(context);
  commands.endRendering();
  if (some_pairs_) pairs_->recordReadback(commands);
}

void Renderer::recordNames(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                           const vk::Rect2D& area) const {
  barrier(commands, target.colour, gpu::unused(), gpu::drawnInto());
  barrier(commands, target.depth, gpu::unused(), gpu::depthTested());
  begin(commands, target, area, vk::AttachmentLoadOp::eClear, std::array{0.0F, 0.0F, 0.0F, 0.0F});
  FrameStats stats;  // of no frame
  const FrameContext context = {commands, frame_set_.handle(), Look::named, stats};
  lines_.record(context);
  arrows_.record(context);
  cones_.recordInside(context);
  if (some_pairs_) pairs_->record(context);
  ellipsoids_.record(context);
  cones_.recordEdges(context);
  commands.endRendering();
}

std::optional<Picked> Renderer::named(std::uint32_t texel) const {
  const std::uint32_t name = texel >> 29U;  // as in common/named.glsl
  const std::uint32_t number = texel & 0x1FFFFFFFU;
  if (name == 0) return std::nullopt;
  Picked picked{.kind = static_cast<Picked::Kind>(name - 1)};
  switch (picked.kind) {
    case Picked::Kind::line:
      picked.tag = lines_.tags()[number];
      break;
    case Picked::Kind::arrow:
      picked.tag = arrows_.tags()[number];
      break;
    case Picked::Kind::cone:
      picked.tag = cones_.tags()[number];
      break;
    case Picked::Kind::ellipsoid:
      picked.tag = ellipsoids_.tags()[number];
      break;
    case Picked::Kind::pair:
      std::tie(picked.i, picked.j) = pairs_->data().pointsOf(number);
      break;
  }
  return picked;
}

FrameStats::Pairs Renderer::pairStats() const {
  return some_pairs_ ? pairs_->stats() : FrameStats::Pairs{};
}

}  // namespace slamscope::engine
