// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// What can be drawn: plain values in the scene's frame (m, z up). The engine knows nothing of what
// they stand for.
namespace slamscope::engine {

/// As written to the picture (no colour-space conversion), each in [0, 1]; a = opacity.
struct Rgba {
  float r = 1.0F, g = 1.0F, b = 1.0F, a = 1.0F;
};

/// The set centre + axes · unit ball. Columns of `axes` are the semi-axis vectors.
struct Ellipsoid {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< m
  Rgba colour = {};
  std::uint64_t tag = 0;  ///< whatever it stands for: what Picked gives back
};

/// Upright cone standing on its tip: apex at `tip`, opening towards +z.
struct Cone {
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();  ///< m
  double height = 0.1;                            ///< m
  double radius = 0.03;                           ///< m, of the rim at tip + height·z
  Rgba colour = {};
  std::uint64_t tag = 0;  ///< as Ellipsoid
};

/// Flat arrow parallel to the floor, from `origin` along `heading`.
struct Arrow {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m
  double heading = 0.0;                              ///< rad, about +z from +x
  double length = 0.25;                              ///< m
  double width = 0.08;                               ///< m, of the head
  Rgba colour = {};
  std::uint64_t tag = 0;  ///< as Ellipsoid
};

/// Connected segments of constant width on screen.
struct Polyline {
  std::vector<Eigen::Vector3d> points;  ///< m
  double width_px = 2.0;
  Rgba colour = {};
  std::uint64_t tag = 0;  ///< as Ellipsoid
};

/// Text at a point of the scene; drawn upright at constant size, not depth-tested.
struct Label {
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();     ///< m
  Eigen::Vector2d offset_px = Eigen::Vector2d::Zero();  ///< of the text's centre, right and down
  std::string text;                                     ///< UTF-8
  double height_px = 14.0;                              ///< font size
  Rgba colour = {};
};

/// Text at a place of the picture. (0, 0) is the picture's upper left corner; lines end with '\n'.
struct ScreenText {
  Eigen::Vector2d position_px = Eigen::Vector2d::Zero();  ///< upper left corner of the text
  std::string text;                                       ///< UTF-8
  double height_px = 14.0;                                ///< font size
  Rgba colour = {};
};

/// Filled rectangle at a place of the picture, under all text (panels, legend swatches).
struct ScreenRect {
  Eigen::Vector2d min_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_px = Eigen::Vector2d::Zero();
  Rgba colour = {};
};

struct PairGlyphs;  // engine/scene/pair_glyphs.hpp

/// Everything of one frame.
struct Scene {
  std::vector<Ellipsoid> ellipsoids;
  std::shared_ptr<const PairGlyphs> pairs;  ///< none: null
  std::vector<Cone> cones;
  std::vector<Arrow> arrows;
  std::vector<Polyline> lines;
  std::vector<Label> labels;
  std::vector<ScreenRect> rects;
  std::vector<ScreenText> texts;
};

}  // namespace slamscope::engine
