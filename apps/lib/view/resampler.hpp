// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "engine/scene/view.hpp"
#include "tracking/frame.hpp"

namespace slamscope::apps {

/// Pictures through a lookup map on the processor, to 1/32 px, black where the map leaves the
/// picture. Where the device is a processor too this is some ten times quicker than its sampling in
/// a shader.
class Resampler {
 public:
  /// `maps`: one for all colours, or one each for red, green, blue (of one size). Throws
  /// std::invalid_argument for another number.
  explicit Resampler(std::span<const engine::LookupMap> maps);
  ~Resampler();
  Resampler(Resampler&&) noexcept;
  Resampler& operator=(Resampler&&) noexcept;

  /// `picture` as the map sees it; the memory of `result` is used again.
  void operator()(const engine::Image& picture, engine::Image& result) const;
  /// The same of a camera's frame. Throws std::logic_error with a map for each colour.
  void operator()(const tracking::Frame& frame, engine::Image& result) const;

 private:
  struct Maps;
  std::unique_ptr<Maps> maps_;
};

}  // namespace slamscope::apps
