// SPDX-License-Identifier: MIT
#include "engine/render/pair_data.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "engine/gpu/barrier.hpp"

namespace slamscope::engine {

namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr std::uint32_t kDifferentGroups = 1;  // as in pairs.glsl
constexpr std::uint32_t kTouching = 2;
constexpr std::uint32_t kSomeLeftOut = 4;

constexpr std::size_t kTexelsOfAPoint = 2;  // as in pairs.glsl

/// What shaders read as texels; undefined where they don't.
vk::Format texelFormat(std::uint32_t binding) {
  switch (binding) {
    case PairData::kPoints:
    case PairData::kBlocks:
      return vk::Format::eR32G32B32A32Sfloat;
    case PairData::kLeftOut:
    case PairData::kDepths:
      return vk::Format::eR32Uint;
    case PairData::kNearest:
      return vk::Format::eR32G32B32A32Uint;
    default:
      return vk::Format::eUndefined;
  }
}

vk::DescriptorType typeOf(std::uint32_t binding) {
  if (binding == PairData::kPairs) return vk::DescriptorType::eUniformBuffer;
  return texelFormat(binding) == vk::Format::eUndefined ? vk::DescriptorType::eStorageBuffer
                                                        : vk::DescriptorType::eUniformTexelBuffer;
}

std::vector<gpu::Binding> bindings() {
  std::vector<gpu::Binding> all;
  for (std::uint32_t i = 0; i < PairData::kBindings; ++i) {
    all.push_back({.binding = i,
                   .type = typeOf(i),
                   .stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment |
                             vk::ShaderStageFlagBits::eCompute});
  }
  return all;
}

std::uint32_t conditionsOf(const PairChoice& choice) {
  return (choice.groups.empty() ? 0 : kDifferentGroups) |
         (choice.touching.empty() ? 0 : kTouching) | (choice.left_out.empty() ? 0 : kSomeLeftOut);
}

std::size_t numberOf(std::pair<std::uint32_t, std::uint32_t> pair) {
  const auto [i, j] = std::minmax(pair.first, pair.second);
  return std::size_t{j} * (j - 1) / 2 + i;
}

/// Pairs a lane: enough work groups to share evenly, few enough that their ends cost nothing.
std::uint32_t runOf(std::size_t pairs) {
  constexpr std::size_t kLanes = 64 * 64;
  return static_cast<std::uint32_t>(std::clamp<std::size_t>((pairs + kLanes - 1) / kLanes, 1, 64));
}

interop::PairsData dataOf(const PairGlyphs& glyphs, const ViewSet& views) {
  const PlanarPoints& points = *glyphs.points;
  const Eigen::Vector2d origin = glyphs.scale * points.origin();
  return {.points = static_cast<std::uint32_t>(points.count()),
          .pairs = static_cast<std::uint32_t>(points.pairCount()),
          .views = static_cast<std::uint32_t>(views.views().size()),
          .law = static_cast<std::uint32_t>(glyphs.axis.kind),
          .gain = static_cast<float>(glyphs.axis.gain),
          .unit = static_cast<float>(glyphs.axis.unit),
          .origin = views.point({origin.x(), origin.y(), 0.0}),
          .ex = views.direction(Eigen::Vector3d::UnitX()),
          .ey = views.direction(Eigen::Vector3d::UnitY()),
          .ez = views.direction(Eigen::Vector3d::UnitZ()),
          .scale = static_cast<float>(glyphs.scale),
          .colour = views.colour(glyphs.colour),
          .conditions = conditionsOf(glyphs.choice),
          .least_area = static_cast<float>(glyphs.choice.least_area),
          .most = glyphs.choice.most,
          .run = runOf(points.pairCount())};
}

}  // namespace

PairData::PairData(const gpu::Core& core)
    : core_(core),
      pairs_(core, sizeof(interop::PairsData), Usage::eUniformBuffer, gpu::MemoryUse::kUpload),
      points_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      blocks_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      left_out_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      counts_(core, sizeof(interop::PairsCounts),
              Usage::eStorageBuffer | Usage::eIndirectBuffer | Usage::eTransferSrc |
                  Usage::eTransferDst,
              gpu::MemoryUse::kDevice),
      counts_read_(core, sizeof(interop::PairsCounts), Usage::eTransferDst,
                   gpu::MemoryUse::kReadback),
      nothing_(core, 0, Usage::eStorageBuffer | Usage::eUniformTexelBuffer,
               gpu::MemoryUse::kDevice),
      set_(core, bindings()) {
  for (std::uint32_t i = 0; i < kBindings; ++i) texels_.emplace_back(nullptr);
  bind(kPairs, pairs_);
  bind(kPoints, points_);
  bind(kBlocks, blocks_);
  bind(kLeftOut, left_out_);
  bind(kCounts, counts_);
  for (const Binding unused : {kList, kRuns, kHistogram, kVisibility, kDepths, kNearest}) {
    bind(unused, nothing_);
  }
  counts_read_.as<interop::PairsCounts>(1)[0] = {};
}

void PairData::bind(Binding binding, const gpu::Buffer& buffer) {
  const vk::Format format = texelFormat(binding);
  if (format == vk::Format::eUndefined) {
    set_.writeBuffer(binding, buffer.handle());
    return;
  }
  texels_[binding] = buffer.texels(format);
  set_.writeTexels(binding, *texels_[binding]);
}

const interop::PairsCounts& PairData::counts() const {
  return counts_read_.as<interop::PairsCounts>(1)[0];
}

std::string PairData::problemWith(const PlanarPoints& points) const {
  const std::size_t most = core_.limits().maxTexelBufferElements;
  const std::size_t needed = points.blocks().size();
  if (needed <= most) return {};
  return "the covariance of " + std::to_string(points.count()) + " points has " +
         std::to_string(needed) + " blocks, and a buffer of this device no more than " +
         std::to_string(most);
}

void PairData::sendPoints(const PlanarPoints& points) {
  const auto blocks = points.blocks();
  if (points_.reserve(points.means().size() * kTexelsOfAPoint * sizeof(Eigen::Vector4f))) {
    bind(kPoints, points_);
  }
  if (blocks_.reserve(blocks.size_bytes())) bind(kBlocks, blocks_);
  std::memcpy(blocks_.mapped().data(), blocks.data(), blocks.size_bytes());
  uploaded_bytes_ = points.bytes();
}

void PairData::sendTable(const PlanarPoints& points) {
  const auto means = points.means();
  const auto table = points_.as<Eigen::Vector4f>(kTexelsOfAPoint * means.size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    const Eigen::Vector4f& P = points.blocks()[i * (i + 1) / 2 + i];
    const float group = i < choice_.groups.size() ? static_cast<float>(choice_.groups[i]) : 0.0F;
    table[2 * i] = {means[i].x(), means[i].y(), group, 0.0F};
    table[2 * i + 1] = {P.x(), P.y(), P.w(), 0.0F};
  }
  for (const std::uint32_t i : choice_.touching) {
    if (i < means.size()) table[2 * i].w() = 1.0F;
  }
}

void PairData::sendLeftOut() {
  const std::size_t words = (std::size_t{pairCount()} + 31) / 32;
  if (choice_.left_out.empty()) return;
  if (left_out_.reserve(words * sizeof(std::uint32_t))) bind(kLeftOut, left_out_);
  const auto bits = left_out_.as<std::uint32_t>(words);
  std::ranges::fill(bits, 0U);
  for (const auto& pair : choice_.left_out) {
    const std::size_t number = numberOf(pair);
    if (pair.first != pair.second && number < pairCount()) bits[number / 32] |= 1U << number % 32;
  }
}

void PairData::update(const PairGlyphs& glyphs, const ViewSet& views) {
  uploaded_bytes_ = 0;
  problem_ = problemWith(*glyphs.points);
  if (!problem_.empty()) return;
  data_ = dataOf(glyphs, views);
  pairs_.as<interop::PairsData>(1)[0] = data_;
  const bool others = glyphs.points != sent_;
  changed_ = others || glyphs.choice != choice_;
  if (!changed_) return;
  choice_ = glyphs.choice;
  if (others) sendPoints(*glyphs.points);
  sent_ = glyphs.points;
  sendTable(*sent_);
  sendLeftOut();
}

std::uint32_t PairData::groupCount() const {
  const std::uint32_t pairs_of_a_group = 64 * data_.run;
  return (data_.pairs + pairs_of_a_group - 1) / pairs_of_a_group;
}

void PairData::recordReset(const vk::raii::CommandBuffer& commands) const {
  // What the ranking found stays.
  commands.fillBuffer(counts_.handle(), 0, offsetof(interop::PairsCounts, least_key), 0);
  barrier(commands, gpu::copyTarget(), gpu::readByAll());
}

void PairData::recordReadback(const vk::raii::CommandBuffer& commands) const {
  commands.copyBuffer(counts_.handle(), counts_read_.handle(),
                      vk::BufferCopy{.size = sizeof(interop::PairsCounts)});
  gpu::barrierToHost(commands, vk::PipelineStageFlagBits2::eTransfer,
                     vk::AccessFlagBits2::eTransferWrite);
}

}  // namespace slamscope::engine
