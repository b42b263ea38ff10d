// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "engine/gpu/buffer.hpp"
#include "engine/gpu/descriptors.hpp"
#include "engine/render/frame_context.hpp"
#include "engine/render/view_set.hpp"
#include "engine/scene/pair_glyphs.hpp"
#include "shaders/interop/pairs.h"

namespace slamscope::engine {

/// The points of PairGlyphs on the device, and the descriptor set (set 1) that all shaders of pairs
/// have in common.
class PairData {
 public:
  /// As in shaders/common/pairs.glsl and what includes it.
  enum Binding : std::uint32_t {
    kPairs,
    kPoints,   ///< texels, as all that is read at places that differ from lane to lane: software
    kBlocks,   ///< rendering (lavapipe 22.3) gathers texels many times faster than storage
    kLeftOut,  ///< texels
    kCounts,
    kList,  ///< of the chosen ones; of the large ones where pairs are splatted
    kRuns,
    kHistogram,
    kVisibility,
    kDepths,   ///< texels: the words of kVisibility
    kNearest,  ///< texels: both entries of a pixel of kVisibility
    kFaces,    ///< what the resolve pass needs of a splatted pair, by view
    kFaceTexels,
    kTiles,  ///< not 0 where something was splatted
    kTileTexels,
    kInView = 22,  ///< texels
    kThen,         ///< texels: kNewAreas
    kIndexThen,    ///< texels
    kOldAreas,     ///< by block, what the area is compared with and what it was last (PairGrowth)
    kNewAreas,
    kRectangles,  ///< texels: of pairs, what each work group of the splatter goes over
    kBindings,
  };

  explicit PairData(const gpu::Core& core);

  /// Takes the frame over; the device must not be drawing. Points are sent only when they are
  /// others than before.
  void update(const PairGlyphs& glyphs, const ViewSet& views);
  /// Sets what is counted back to 0.
  void recordReset(const vk::raii::CommandBuffer& commands) const;
  /// Brings the counts to the host.
  void recordReadback(const vk::raii::CommandBuffer& commands) const;
  /// Work groups of 64 lanes that go over all pairs, PairsData::run each.
  [[nodiscard]] std::uint32_t groupCount() const;

  /// Why the points of the last update() can't be on this device; empty: they are.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  [[nodiscard]] std::uint32_t pairCount() const { return data_.pairs; }
  /// The last update() brought other points or another choice.
  [[nodiscard]] bool changed() const { return changed_; }
  [[nodiscard]] std::size_t uploadedBytes() const { return uploaded_bytes_; }
  [[nodiscard]] const PairChoice& choice() const { return choice_; }
  [[nodiscard]] const interop::PairsData& data() const { return data_; }
  [[nodiscard]] const PlanarPointsPtr& points() const { return sent_; }
  /// Of the frame last waited for.
  [[nodiscard]] const interop::PairsCounts& counts() const;

  [[nodiscard]] const gpu::DescriptorSet& set() const { return set_; }
  [[nodiscard]] vk::Buffer countsBuffer() const { return counts_.handle(); }
  /// The points i < j of the pair that shaders number so.
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> pointsOf(std::uint32_t number) const;
  /// Gives a pass's buffer its place in the set.
  void bind(Binding binding, const gpu::Buffer& buffer);

 private:
  void sendPoints(const PairGlyphs& glyphs, const View& first_eye);
  void sendTable(const PlanarPoints& points);
  void sendLeftOut();
  /// True where another point came into view or left it.
  [[nodiscard]] bool sendInView(const PairGlyphs& glyphs, const ViewSet& views);

  const gpu::Core& core_;
  gpu::Buffer pairs_, points_, blocks_, left_out_, in_view_, counts_, counts_read_, nothing_;
  std::vector<std::uint32_t> order_;          ///< points as the device has them, by index
  std::vector<std::uint32_t> seen_;           ///< bits of in_view_
  std::vector<vk::raii::BufferView> texels_;  ///< by binding
  gpu::DescriptorSet set_;
  PlanarPointsPtr sent_;  ///< what the device has; held, so that no other can have its address
  interop::PairsData data_ = {};
  PairChoice choice_;
  std::string problem_;
  bool changed_ = false;
  std::size_t uploaded_bytes_ = 0;
};

}  // namespace slamscope::engine
