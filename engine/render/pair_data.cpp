// SPDX-License-Identifier: MIT
#include "engine/render/pair_data.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <tuple>

#include "engine/gpu/barrier.hpp"
#include "engine/render/covariance_room.hpp"
#include "engine/scene/clip.hpp"

namespace slamscope::engine {

namespace {

using Usage = vk::BufferUsageFlagBits;

constexpr std::uint32_t kDifferentGroups = 1;  // as in pairs.glsl
constexpr std::uint32_t kTouching = 2;
constexpr std::uint32_t kSomeLeftOut = 4;
constexpr std::uint32_t kBothInView = 8;

constexpr std::size_t kTexelsOfAPoint = 2;  // as in pairs.glsl

/// What shaders read as texels; undefined where they don't.
vk::Format texelFormat(std::uint32_t binding) {
  switch (binding) {
    case PairData::kPoints:
    case PairData::kBlocks:
    case PairData::kFaceTexels:
      return vk::Format::eR32G32B32A32Sfloat;
    case PairData::kLeftOut:
    case PairData::kDepths:
    case PairData::kTileTexels:
    case PairData::kInView:
    case PairData::kIndexThen:
    case PairData::kRectangles:
      return vk::Format::eR32Uint;
    case PairData::kThen:
      return vk::Format::eR32G32Sfloat;
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
         (choice.touching.empty() ? 0 : kTouching) | (choice.left_out.empty() ? 0 : kSomeLeftOut) |
         (choice.in_view ? kBothInView : 0);
}

/// Of a pair by its places in the order.
std::size_t numberOf(std::uint32_t a, std::uint32_t b) {
  const auto [i, j] = std::minmax(a, b);
  return std::size_t{j} * (j - 1) / 2 + i;
}

/// In bands across the way to the eye (seen from `eye`, in the points' own coordinates), the
/// nearest band first. Of pairs taken in this order most of the later ones are hidden, which costs
/// little to find out; and what is near in it is near in the picture, and so in memory.
std::vector<std::uint32_t> nearestFirst(std::span<const Eigen::Vector2f> means,
                                        const Eigen::Vector2f& eye) {
  constexpr float kBands = 32.0F;
  Eigen::AlignedBox2f box;
  for (const Eigen::Vector2f& mean : means) {
    if (mean.allFinite()) box.extend(mean);
  }
  if (box.isEmpty()) box.extend(Eigen::Vector2f::Zero().eval());
  const Eigen::Vector2f centre = box.center();
  const float reach = std::max(0.5F * box.diagonal().norm(), 1e-30F);
  const Eigen::Vector2f to_eye = (eye - centre).stableNormalized();
  std::vector<std::tuple<float, float, std::uint32_t>> keyed;
  for (std::uint32_t i = 0; i < means.size(); ++i) {
    Eigen::Vector2f p = Eigen::Vector2f::Zero();
    if (means[i].allFinite()) p = (means[i] - centre) / reach;
    const float band = std::floor(-0.5F * kBands * p.dot(to_eye));
    keyed.emplace_back(band, to_eye.y() * p.x() - to_eye.x() * p.y(), i);
  }
  std::ranges::sort(keyed);
  std::vector<std::uint32_t> order;
  for (const auto& [band, across, i] : keyed) order.push_back(i);
  return order;
}

/// Pairs a lane: enough work groups to share evenly, few enough that their ends cost nothing.
std::uint32_t runOf(std::size_t pairs) {
  constexpr std::size_t kLanesAtOnce = 64 * 64;
  return static_cast<std::uint32_t>(
      std::clamp<std::size_t>((pairs + kLanesAtOnce - 1) / kLanesAtOnce, 1, 64));
}

bool inPicture(const View& view, const Eigen::Vector3d& p_scene, double near) {
  const Eigen::Vector3d p = view.T_eye_scene * p_scene;
  if (!(p.z() >= near)) return false;
  const Eigen::Array2d corner = project(view.camera, p).array() + 0.5;
  return (corner >= 0.0).all() && corner.x() < view.camera.width && corner.y() < view.camera.height;
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
          .run = runOf(points.pairCount()),
          .most_by = static_cast<std::uint32_t>(glyphs.choice.most_by)};
}

}  // namespace

PairData::PairData(const gpu::Core& core)
    : core_(core),
      pairs_(core, sizeof(interop::PairsData), Usage::eUniformBuffer, gpu::MemoryUse::kUpload),
      points_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      blocks_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      left_out_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
      in_view_(core, 0, Usage::eUniformTexelBuffer, gpu::MemoryUse::kUpload),
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
  bind(kInView, in_view_);
  bind(kCounts, counts_);
  for (std::uint32_t i = kList; i < kBindings; ++i) {
    if (i != kInView) bind(static_cast<Binding>(i), nothing_);
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

void PairData::sendPoints(const PairGlyphs& glyphs, const View& first_eye) {
  const PlanarPoints& points = *glyphs.points;
  const auto blocks = points.blocks();
  if (points_.reserve(points.means().size() * kTexelsOfAPoint * sizeof(Eigen::Vector4f))) {
    bind(kPoints, points_);
  }
  if (blocks_.reserve(blocks.size_bytes())) bind(kBlocks, blocks_);
  std::memcpy(blocks_.mapped().data(), blocks.data(), blocks.size_bytes());
  const Eigen::Vector2d eye = first_eye.T_eye_scene.inverse().translation().head<2>();
  order_ = nearestFirst(points.means(), (eye / glyphs.scale - points.origin()).cast<float>());
  uploaded_bytes_ = points.bytes();
}

void PairData::sendTable(const PlanarPoints& points) {
  const auto means = points.means();
  std::vector<bool> touched(means.size(), false);
  for (const std::uint32_t i : choice_.touching) {
    if (i < means.size()) touched[i] = true;
  }
  auto texel = points_.as<Eigen::Vector4f>(kTexelsOfAPoint * means.size()).begin();
  for (const std::uint32_t i : order_) {
    const Eigen::Vector4f& P = points.blocks()[std::size_t{i} * (i + 1) / 2 + i];
    const float group = i < choice_.groups.size() ? static_cast<float>(choice_.groups[i]) : 0.0F;
    *texel++ = {means[i].x(), means[i].y(), group, touched[i] ? 1.0F : 0.0F};
    *texel++ = {P.x(), P.y(), P.w(), static_cast<float>(i)};
  }
}

void PairData::sendLeftOut() {
  const std::size_t words = (std::size_t{pairCount()} + 31) / 32;
  if (choice_.left_out.empty()) return;
  if (left_out_.reserve(words * sizeof(std::uint32_t))) bind(kLeftOut, left_out_);
  const auto bits = left_out_.as<std::uint32_t>(words);
  std::ranges::fill(bits, 0U);
  std::vector<std::uint32_t> place(order_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) place[order_[i]] = i;
  for (const auto& [a, b] : choice_.left_out) {
    if (a == b || std::max(a, b) >= place.size()) continue;
    const std::size_t number = numberOf(place[a], place[b]);
    bits[number / 32] |= 1U << number % 32;
  }
}

bool PairData::sendInView(const PairGlyphs& glyphs, const ViewSet& views) {
  const PlanarPoints& points = *glyphs.points;
  std::vector<std::uint32_t> bits((points.means().size() + 31) / 32, 0);
  for (std::size_t i = 0; i < points.means().size(); ++i) {
    const Eigen::Vector2d p = glyphs.scale * (points.origin() + points.means()[i].cast<double>());
    const auto seen_by = [&](const View& view) {
      return inPicture(view, {p.x(), p.y(), 0.0}, views.options().near_m);
    };
    if (std::ranges::any_of(views.views(), seen_by)) bits[i / 32] |= 1U << i % 32;
  }
  if (bits == seen_) return false;
  if (in_view_.reserve(bits.size() * sizeof(std::uint32_t))) bind(kInView, in_view_);
  std::ranges::copy(bits, in_view_.as<std::uint32_t>(bits.size()).begin());
  seen_ = std::move(bits);
  return true;
}

void PairData::update(const PairGlyphs& glyphs, const ViewSet& views) {
  uploaded_bytes_ = 0;
  problem_ = lackOfRoom(core_, *glyphs.points);
  if (!problem_.empty()) return;
  data_ = dataOf(glyphs, views);
  pairs_.as<interop::PairsData>(1)[0] = data_;
  const bool others = glyphs.points != sent_;
  const bool others_seen = glyphs.choice.in_view && sendInView(glyphs, views);
  changed_ = others || others_seen || glyphs.choice != choice_;
  if (!changed_) return;
  choice_ = glyphs.choice;
  if (others) sendPoints(glyphs, views.views().front());
  sent_ = glyphs.points;
  sendTable(*sent_);
  sendLeftOut();
}

std::pair<std::uint32_t, std::uint32_t> PairData::pointsOf(std::uint32_t number) const {
  std::uint32_t j = 1;
  while (numberOf(0, j + 1) <= number) ++j;
  return std::minmax({order_.at(number - numberOf(0, j)), order_.at(j)});
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
