// SPDX-License-Identifier: MIT
#include "engine/render/pair_splats.hpp"

#include <algorithm>

#include "engine/gpu/barrier.hpp"
#include "engine/render/shader_code.hpp"

namespace slamscope::engine {

namespace {

constexpr std::uint32_t kPointsAcross = 64;  // a rectangle, one a lane, as in pairs_splat.comp
constexpr std::uint32_t kSlices = 8;
constexpr std::uint32_t kLargeGroups = 32;  // that go over the list of large ones
constexpr std::size_t kBytesOfAPixel = 2 * sizeof(std::uint64_t);
constexpr std::size_t kBytesOfAFace = 12 * sizeof(float);
constexpr std::uint32_t kTile = 32;  // px, as in common/pair_tiles.glsl

using Usage = vk::BufferUsageFlagBits;

std::vector<vk::DescriptorSetLayout> splatSets(const PassSetup& setup, const PairData& data) {
  return {setup.frame_layout, data.set().layout()};
}

gpu::PipelineInfo resolveInfo(const PassSetup& setup, const PairData& data) {
  return {.vertex = shaderCode("pairs_tiles_vert"),
          .fragment = shaderCode("pairs_resolve_frag"),
          .sets = splatSets(setup, data),
          .view_mask = setup.view_mask,
          .depth_test = true,
          .depth_write = true};
}

}  // namespace

bool PairSplats::possible(const gpu::Core& core, const PairData& data, vk::Extent2D extent) {
  const std::size_t views = data.data().views;
  const std::size_t pixels = std::size_t{extent.width} * extent.height * views;
  const std::size_t faces = data.pairCount() * views;
  const std::size_t bytes = std::max(pixels * kBytesOfAPixel, faces * kBytesOfAFace);
  const std::size_t texels =
      std::max(4 * pixels, 3 * faces);  // words of the one, vec4 of the other
  return core.wideAtomics() && bytes <= core.limits().maxStorageBufferRange &&
         texels <= core.limits().maxTexelBufferElements;
}

PairSplats::PairSplats(const PassSetup& setup, const PairData& data)
    : visibility_(setup.core, 0,
                  Usage::eStorageBuffer | Usage::eUniformTexelBuffer | Usage::eTransferDst,
                  gpu::MemoryUse::kDevice),
      large_(setup.core, 0, Usage::eStorageBuffer, gpu::MemoryUse::kDevice),
      faces_(setup.core, 0, Usage::eStorageBuffer | Usage::eUniformTexelBuffer,
             gpu::MemoryUse::kDevice),
      tiles_(setup.core, 0,
             Usage::eStorageBuffer | Usage::eUniformTexelBuffer | Usage::eTransferDst,
             gpu::MemoryUse::kDevice),
      rectangles_(setup.core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      small_pass_(setup.core, shaderCode("pairs_splat_comp"), splatSets(setup, data), {VK_FALSE}),
      large_pass_(setup.core, shaderCode("pairs_splat_comp"), splatSets(setup, data), {VK_TRUE}),
      resolve_(setup.core, resolveInfo(setup, data), 0, Picked::Kind::pair) {}

void PairSplats::update(PairData& data, vk::Extent2D extent) {
  const std::size_t views = data.data().views;
  visibility_bytes_ = std::size_t{extent.width} * extent.height * views * kBytesOfAPixel;
  tile_count_ = ((extent.width + kTile - 1) / kTile) * ((extent.height + kTile - 1) / kTile);
  visibility_.reserve(visibility_bytes_);
  large_.reserve(data.pairCount() * views * 2 * sizeof(std::uint32_t));
  faces_.reserve(data.pairCount() * views * kBytesOfAFace);
  tiles_.reserve(tile_count_ * views * sizeof(std::uint32_t));
  for (const auto binding : {PairData::kVisibility, PairData::kDepths, PairData::kNearest}) {
    data.bind(binding, visibility_);
  }
  data.bind(PairData::kList, large_);
  for (const auto binding : {PairData::kFaces, PairData::kFaceTexels}) data.bind(binding, faces_);
  for (const auto binding : {PairData::kTiles, PairData::kTileTexels}) data.bind(binding, tiles_);
  if (data.data().points != points_) sendRectangles(data);
}

/// What is drawn first hides most of what comes later, which then costs little.
void PairSplats::sendRectangles(PairData& data) {
  const std::uint32_t points = points_ = data.data().points;
  struct Rectangle {
    std::uint32_t first_i, first_j;
  };
  std::vector<Rectangle> all;
  const std::uint32_t rows = (points + kPointsAcross - 1) / kPointsAcross;
  for (std::uint32_t j = 0; j < points; j += rows) {
    for (std::uint32_t i = 0; i < std::min(j + rows, points); i += kPointsAcross) {
      all.push_back({i, j});
    }
  }
  std::ranges::stable_sort(all, {}, [](const Rectangle& r) { return r.first_i + r.first_j; });
  rectangles_.reserve(all.size() * sizeof(std::uint32_t));
  data.bind(PairData::kRectangles, rectangles_);
  auto texel = rectangles_.as<std::uint32_t>(all.size()).begin();
  for (const Rectangle& r : all) *texel++ = r.first_i | r.first_j << 16U;
  rectangle_count_ = static_cast<std::uint32_t>(all.size());
}

void PairSplats::recordSplats(const vk::raii::CommandBuffer& commands, vk::DescriptorSet frame_set,
                              const PairData& data) const {
  commands.fillBuffer(visibility_.handle(), 0, visibility_bytes_, ~0U);
  commands.fillBuffer(tiles_.handle(), 0, tile_count_ * data.data().views * sizeof(std::uint32_t),
                      0);
  barrier(commands, gpu::copyTarget(), gpu::computed());
  const std::array sets = {frame_set, data.set().handle()};
  small_pass_.bind(commands, sets);
  commands.dispatch(rectangle_count_, 1, 1);
  barrier(commands, gpu::computed(), gpu::computed());
  large_pass_.bind(commands, sets);
  commands.dispatch(kLargeGroups, kSlices, 1);
  barrier(commands, gpu::computed(), gpu::readByAll());
}

void PairSplats::record(const FrameContext& context, const PairData& data) const {
  context.draw("pairs", resolve_[context.look], data.set().handle(), 4,
               static_cast<int>(tile_count_));
}

}  // namespace slamscope::engine
