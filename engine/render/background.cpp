// SPDX-License-Identifier: MIT
#include "engine/render/background.hpp"

#include <algorithm>
#include <array>

#include "engine/gpu/image.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kPicture = 0;  // and 1, as in background.frag
constexpr std::uint32_t kMap = 2;      // and 3

// interop::ViewData::background
constexpr std::uint32_t kNone = 0;
constexpr std::uint32_t kOwnPixels = 1;
constexpr std::uint32_t kMapped = 2;

gpu::Binding sampled(std::uint32_t binding) {
  return {.binding = binding,
          .type = vk::DescriptorType::eCombinedImageSampler,
          .stages = vk::ShaderStageFlagBits::eFragment};
}

}  // namespace

BackgroundPass::Eye::Eye(const gpu::Core& core)
    : own_pixels(core, 4),
      picture(core, vk::Format::eR8G8B8A8Unorm, 4),
      map(core, vk::Format::eR32G32Sfloat, 2 * sizeof(float)) {}

BackgroundPass::BackgroundPass(const PassSetup& setup)
    : set_(setup.core,
           {sampled(kPicture), sampled(kPicture + 1), sampled(kMap), sampled(kMap + 1)}),
      pipeline_(setup.core, {.vertex = shaderCode("background_vert"),
                             .fragment = shaderCode("background_frag"),
                             .sets = {setup.frame_layout, set_.layout()},
                             .view_mask = setup.view_mask,
                             .blend = false}),
      sampler_(setup.core.device(), gpu::bilinearWithBlackBorder()),
      eyes_{Eye(setup.core), Eye(setup.core)} {
  bind(0);
  bind(1);
}

void BackgroundPass::bind(std::uint32_t eye) const {
  set_.writeImage(kPicture + eye, 0, eyes_[eye].picture.view(), *sampler_);
  set_.writeImage(kMap + eye, 0, eyes_[eye].map.view(), *sampler_);
}

bool BackgroundPass::any(std::uint32_t kind) const {
  return std::ranges::any_of(eyes_, [kind](const Eye& eye) { return eye.kind == kind; });
}

void BackgroundPass::update(const ViewSet& views) {
  const auto extent = [](const auto& picture) {
    return vk::Extent2D(static_cast<std::uint32_t>(picture.width),
                        static_cast<std::uint32_t>(picture.height));
  };
  for (std::uint32_t i = 0; i < views.views().size(); ++i) {
    const Background& background = views.views()[i].background;
    Eye& eye = eyes_[i];
    eye.kind = views.data().views[i].background;
    if (eye.kind == kNone) continue;
    const auto texels = std::as_bytes(std::span(background.image->rgba));
    if (eye.kind == kOwnPixels) {
      eye.own_pixels.write(extent(*background.image), texels);
      continue;
    }
    bool renewed = eye.picture.write(extent(*background.image), texels);
    if (background.map != eye.uploaded_map) {
      renewed |=
          eye.map.write(extent(*background.map), std::as_bytes(std::span(background.map->uv_px)));
      eye.uploaded_map = background.map;
    }
    if (renewed) bind(i);
  }
}

bool BackgroundPass::recordCopies(const vk::raii::CommandBuffer& commands,
                                  const gpu::DeviceImage& target) {
  for (Eye& eye : eyes_) {
    eye.picture.record(commands);
    eye.map.record(commands);
  }
  if (!any(kOwnPixels)) {
    barrier(commands, target, gpu::unused(), gpu::drawnInto());
    return false;
  }
  barrier(commands, target, gpu::unused(), gpu::copyTarget());
  for (std::uint32_t i = 0; i < target.layers(); ++i) {
    if (eyes_[i].kind == kOwnPixels) {
      eyes_[i].own_pixels.recordCopy(commands, target, i);
    } else {
      commands.clearColorImage(
          target.handle(), vk::ImageLayout::eTransferDstOptimal,
          vk::ClearColorValue(std::array{0.0F, 0.0F, 0.0F, 1.0F}),
          vk::ImageSubresourceRange{vk::ImageAspectFlagBits::eColor, 0, 1, i, 1});
    }
  }
  barrier(commands, target, gpu::copyTarget(), gpu::drawnInto());
  return true;
}

void BackgroundPass::record(const FrameContext& context) const {
  context.draw("background", pipeline_, set_.handle(), 4, any(kMapped) ? 1 : 0);
}

}  // namespace slamscope::engine
