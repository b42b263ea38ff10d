// SPDX-License-Identifier: MIT
#include "engine/render/background.hpp"

#include "engine/gpu/image.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kPicture = 0;  // and 1, as in background.frag
constexpr std::uint32_t kMap = 2;      // and 3

gpu::Binding sampled(std::uint32_t binding) {
  return {.binding = binding,
          .type = vk::DescriptorType::eCombinedImageSampler,
          .stages = vk::ShaderStageFlagBits::eFragment};
}

}  // namespace

BackgroundPass::Eye::Eye(const gpu::Core& core)
    : picture(core, vk::Format::eR8G8B8A8Unorm, 4),
      map(core, vk::Format::eR32G32Sfloat, 2 * sizeof(float)) {}

BackgroundPass::BackgroundPass(const PassSetup& setup)
    : set_(setup.core,
           {sampled(kPicture), sampled(kPicture + 1), sampled(kMap), sampled(kMap + 1)}),
      setup_(setup),
      sampler_(setup.core.device(), gpu::bilinearWithBlackBorder()),
      eyes_{Eye(setup.core), Eye(setup.core)} {
  bind(0);
  bind(1);
}

void BackgroundPass::bind(std::uint32_t eye) const {
  set_.writeImage(kPicture + eye, 0, eyes_[eye].picture.view(), *sampler_);
  set_.writeImage(kMap + eye, 0, eyes_[eye].map.view(), *sampler_);
}

void BackgroundPass::update(const ViewSet& views) {
  kinds_ = 0;
  for (std::uint32_t i = 0; i < views.views().size(); ++i) {
    const Background& background = views.views()[i].background;
    if (!background.image) continue;
    kinds_ |= views.data().views[i].background;  // 1: pixel by pixel, 2: through the map
    Eye& eye = eyes_[i];
    const auto extent = [](const auto& picture) {
      return vk::Extent2D(static_cast<std::uint32_t>(picture.width),
                          static_cast<std::uint32_t>(picture.height));
    };
    bool renewed = eye.picture.write(extent(*background.image),
                                     std::as_bytes(std::span(background.image->rgba)));
    if (background.map && background.map != eye.uploaded_map) {
      renewed |=
          eye.map.write(extent(*background.map), std::as_bytes(std::span(background.map->uv_px)));
      eye.uploaded_map = background.map;
    }
    if (renewed) bind(i);
  }
  std::optional<gpu::Pipeline>& pipeline = pipelines_[kinds_];
  if (kinds_ == 0 || pipeline) return;
  pipeline.emplace(setup_.core,
                   gpu::PipelineInfo{.vertex = shaderCode("background_vert"),
                                     .fragment = shaderCode("background_frag"),
                                     .sets = {setup_.frame_layout, set_.layout()},
                                     .view_mask = setup_.view_mask,
                                     .blend = false,
                                     .constants = {setup_.view_mask == 1 ? VK_FALSE : VK_TRUE,
                                                   kinds_ & 1U, kinds_ >> 1U}});
}

void BackgroundPass::recordUpload(const vk::raii::CommandBuffer& commands) {
  for (Eye& eye : eyes_) {
    eye.picture.record(commands);
    eye.map.record(commands);
  }
}

void BackgroundPass::record(const FrameContext& context) const {
  if (kinds_ > 0) context.draw("background", *pipelines_[kinds_], set_.handle(), 4, 1);
}

}  // namespace slamscope::engine
