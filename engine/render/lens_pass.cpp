// SPDX-License-Identifier: MIT
#include "engine/render/lens_pass.hpp"

#include <array>

#include "engine/gpu/barrier.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {
namespace {

constexpr std::uint32_t kDrawn = 0;
constexpr std::uint32_t kLenses = 1;

interop::vec3 floats(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

interop::LensData lensData(const Lens& lens, const vk::Extent2D& extent) {
  return {.axis = {static_cast<float>(lens.centre.x() * extent.width),
                   static_cast<float>(lens.centre.y() * extent.height)},
          .half_height = 0.5F * static_cast<float>(extent.height),
          .k = floats(lens.k),
          .scale = floats(lens.scale),
          .plain = lens.plain() ? 1U : 0U};
}

}  // namespace

LensPass::LensPass(const gpu::Core& core, const gpu::DeviceImage& drawn)
    : drawn_(drawn),
      shown_(core, {.format = drawn.format(),
                    .extent = drawn.extent(),
                    .layers = drawn.layers(),
                    .usage = vk::ImageUsageFlagBits::eColorAttachment |
                             vk::ImageUsageFlagBits::eTransferSrc,
                    .readable = true}),
      lenses_(core, sizeof(interop::LensesData), vk::BufferUsageFlagBits::eUniformBuffer,
              gpu::MemoryUse::kUpload),
      set_(core, {{.binding = kDrawn,
                   .type = vk::DescriptorType::eCombinedImageSampler,
                   .stages = vk::ShaderStageFlagBits::eFragment},
                  {.binding = kLenses,
                   .type = vk::DescriptorType::eUniformBuffer,
                   .stages = vk::ShaderStageFlagBits::eFragment}}),
      pipeline_(core, {.vertex = shaderCode("lens_vert"),
                       .fragment = shaderCode("lens_frag"),
                       .sets = {set_.layout()},
                       .view_mask = (1U << drawn.layers()) - 1U,
                       .depth_format = vk::Format::eUndefined,
                       .blend = false}),
      sampler_(core.device(), gpu::bilinearWithBlackBorder()) {
  set_.writeImage(kDrawn, 0, drawn.view(), *sampler_);
  set_.writeBuffer(kLenses, lenses_.handle());
}

void LensPass::wear(std::span<const Lens> lenses) {
  interop::LensesData& data = lenses_.as<interop::LensesData>(1)[0];
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    data.lenses[i] = lensData(lenses[i], drawn_.extent());
  }
}

void LensPass::record(const vk::raii::CommandBuffer& commands) const {
  barrier(commands, drawn_, gpu::drawnInto(), gpu::sampledInFragment());
  barrier(commands, shown_, gpu::unused(), gpu::drawnInto());
  const vk::RenderingAttachmentInfo colour = {
      .imageView = shown_.view(),
      .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eDontCare,
      .storeOp = vk::AttachmentStoreOp::eStore};
  const vk::Rect2D area = {.extent = shown_.extent()};
  commands.beginRendering({.renderArea = area,
                           .layerCount = 1,
                           .viewMask = (1U << shown_.layers()) - 1U,
                           .colorAttachmentCount = 1,
                           .pColorAttachments = &colour});
  commands.setViewport(0, vk::Viewport{.width = static_cast<float>(area.extent.width),
                                       .height = static_cast<float>(area.extent.height),
                                       .maxDepth = 1.0F});
  commands.setScissor(0, area);
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, pipeline_.handle());
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, pipeline_.layout(), 0,
                              set_.handle(), {});
  commands.draw(4, 1, 0, 0);
  commands.endRendering();
  barrier(commands, shown_, gpu::drawnInto(), gpu::copySource());
}

}  // namespace slamscope::engine
