// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/gpu.hpp"
#include "engine/render/options.hpp"
#include "engine/scene/glyphs.hpp"
#include "engine/scene/lens.hpp"
#include "engine/scene/picked.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// Draws scenes into pictures, without a window. One picture a view; all views in the same draws.
///
///   Offscreen offscreen(std::make_shared<Gpu>(), 1280, 720);
///   Image picture = offscreen.draw({&view, 1}, scene).front();
class Offscreen {
 public:
  /// width, height in px; views: 1 or 2. Throws std::invalid_argument for sizes that can't be.
  Offscreen(std::shared_ptr<Gpu> gpu, int width, int height, int views = 1);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  /// Lenses that the pictures are seen through from now on, one a view: the display's
  /// pre-distortion, the last thing done. Plain ones change no byte. Throws std::invalid_argument
  /// for another number than that of the views (or none).
  void wear(std::span<const Lens> lenses);

  /// One picture a view, opaque. Throws std::invalid_argument where the number of views or a
  /// camera's size is not that of the constructor, or a background's size does not fit.
  [[nodiscard]] std::vector<Image> draw(std::span<const View> views, const Scene& scene,
                                        const RenderOptions& options = {});
  /// The same into pictures whose memory is used again.
  void draw(std::span<const View> views, const Scene& scene, const RenderOptions& options,
            std::vector<Image>& pictures);

  /// What the pictures of the last draw() show at a pixel (before any lens), by whichever way it
  /// was drawn: the glyph that covers at least half of it and is not hidden. Nothing outside of the
  /// picture and before the first draw(). Throws std::invalid_argument for a view that wasn't
  /// drawn.
  [[nodiscard]] std::optional<Picked> pick(const PickPlace& place);

  /// Of the last draw().
  [[nodiscard]] const FrameStats& lastStats() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::engine
