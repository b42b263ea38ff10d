// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "engine/gpu/descriptors.hpp"

namespace slamscope::engine {

/// The glyphs of one pass on the device: binding 0 of its set, read by the vertex shader.
class Instances {
 public:
  /// `more`: further bindings of the pass's set.
  explicit Instances(const gpu::Core& core, std::vector<gpu::Binding> more = {});

  /// The device must not be drawing.
  template <typename Glyph>
  void upload(std::span<const Glyph> glyphs) {
    static_assert(std::is_trivially_copyable_v<Glyph>);
    reserve(glyphs.size_bytes());
    std::memcpy(buffer_.mapped().data(), glyphs.data(), glyphs.size_bytes());
    count_ = static_cast<int>(glyphs.size());
  }

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] const gpu::DescriptorSet& set() const { return set_; }

 private:
  void reserve(std::size_t bytes);

  gpu::Buffer buffer_;
  gpu::DescriptorSet set_;
  int count_ = 0;
};

}  // namespace slamscope::engine
