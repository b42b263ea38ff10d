// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "engine/scene/pair_glyphs.hpp"
#include "engine/scene/view.hpp"

namespace slamscope::engine {

/// Pairs as VTK draws them, off-screen, read back. Needs an X display (xvfb-run).
class VtkGlyphs {
 public:
  enum class Way {
    spheres,        ///< vtkOpenGLSphereMapper: a ray-cast sphere of the ellipsoid's volume
    gaussians,      ///< vtkPointGaussianMapper: the same as a flat disc, shaded by distance
    tensors,        ///< vtkTensorGlyph: the ellipsoid as a mesh of 16 × 16
    meshes,         ///< vtkGlyph3D: the sphere as a mesh of 8 × 8
    coarse_meshes,  ///< the same of 3 × 3, the least that vtkSphereSource makes
  };

  /// `frames`: what is drawn, one after another. All that a pair is made of is computed here, once,
  /// so that draw() does nothing but draw. Two eyes are drawn side by side.
  VtkGlyphs(Way way, std::span<const View> eyes, std::span<const PairGlyphs> frames);
  ~VtkGlyphs();
  VtkGlyphs(const VtkGlyphs&) = delete;
  VtkGlyphs& operator=(const VtkGlyphs&) = delete;

  /// Frame k modulo their number; others than the last one are as new to VTK. RGBA, from below.
  std::span<const std::uint8_t> draw(std::size_t k);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slamscope::engine
