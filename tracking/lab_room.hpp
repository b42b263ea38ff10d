// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "tracking/lab.hpp"
#include "tracking/lab_floor.hpp"
#include "tracking/lab_light.hpp"
#include "tracking/lab_shapes.hpp"
#include "tracking/lab_tag_face.hpp"

namespace slamscope::tracking::lab {

/// What a ray meets first.
struct Sight {
  int part = -1;  ///< equal numbers: no edge between; −1: nothing
  double t = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, unit
};

/// Printer's ink and paper.
[[nodiscard]] Eigen::Array3f albedo(TagFace::Ink ink);

/// All that stands still: floor, printed tags, posts, a few things along the walls.
class Room {
 public:
  /// Throws std::invalid_argument for posts or tags that can't be.
  explicit Room(const LabOptions& options);

  /// What rays near each other may meet besides the floor: indices.
  struct Candidates {
    std::vector<std::size_t> tags, posts, things;
  };
  /// For rays turned by up to `spread` (rad) from this one.
  [[nodiscard]] Candidates candidates(const Ray& ray_world, double spread) const;
  [[nodiscard]] Sight trace(const Ray& ray_world, const Candidates& candidates) const;
  /// How bright that is: blue, green, red, of 255.
  [[nodiscard]] Eigen::Array3f colour(const Ray& ray_world, const Sight& sight) const;
  /// A part that stands on the floor.
  [[nodiscard]] static bool isSolid(int part);
  /// Distance along the ray to the first solid that stands on the floor (not the floor itself).
  [[nodiscard]] double distanceToSolids(const Ray& ray_world) const;
  [[nodiscard]] const LightMap& light() const { return light_; }

 private:
  struct Post {
    Cylinder shaft, foot;
    Ball ball;
  };
  struct Thing {
    Prism shape;
    Ball ball;
    Eigen::Array3f albedo;
  };
  struct Tag {
    TagFace face;
    Ball ball;
    Eigen::Isometry3d T_tag_world;
  };
  [[nodiscard]] static std::vector<Thing> furniture();
  void addBoards(const LabOptions& options);
  [[nodiscard]] static LightMap makeLight(const LabOptions& options);

  static void traceFloor(const Ray& ray, Sight& nearest);
  void traceWalls(const Ray& ray, Sight& nearest) const;
  void traceTags(const Ray& ray, const std::vector<std::size_t>& of, Sight& nearest) const;
  void tracePosts(const Ray& ray, const std::vector<std::size_t>& of, Sight& nearest) const;
  void traceThings(const Ray& ray, const std::vector<std::size_t>& of, Sight& nearest) const;
  [[nodiscard]] static Eigen::Array3f wallPaint(int part);
  [[nodiscard]] static Eigen::Array3f postColour(const Eigen::Vector3d& p_world,
                                                 const Sight& sight);

  Floor floor_;
  Eigen::Vector2d walls_;
  std::vector<Tag> tags_;
  std::vector<Post> posts_;
  std::vector<Thing> things_;
  LightMap light_;
};

}  // namespace slamscope::tracking::lab
