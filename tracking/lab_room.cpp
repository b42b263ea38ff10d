// SPDX-License-Identifier: MIT
#include "tracking/lab_room.hpp"

#include <cmath>
#include <stdexcept>

namespace slamscope::tracking::lab {
namespace {

// Numbers of parts: every kind has a range of its own.
constexpr int kWalls = 10, kFloor = 0, kTape = 1, kTags = 100, kPosts = 10000, kThings = 1000000;
constexpr int kFoot = 0, kShaft = 1, kBand = 2, kCap = 3;  // of one post
constexpr double kFootHeight = 0.005;                      // m

std::vector<Blocker> blockers(const LabOptions& options) {
  std::vector<Blocker> result;
  for (const LabPost& post : options.posts) {
    const Eigen::Vector3d p =
        options.T_world_map * Eigen::Vector3d(post.p_map.x(), post.p_map.y(), 0);
    result.push_back(
        {.p_world = p.head<2>(), .radius = options.post_radius, .height = options.post_height});
  }
  if (!options.furniture) return result;
  // Roughly.
  result.push_back({.p_world = {-3.02, 0.34}, .radius = 0.26, .height = 0.24, .contact = 0.05});
  result.push_back({.p_world = {-3.08, -0.16}, .radius = 0.17, .height = 0.18, .contact = 0.05});
  result.push_back({.p_world = {3.04, -0.35}, .radius = 0.25, .height = 0.20, .contact = 0.05});
  return result;
}

}  // namespace

Eigen::Array3f albedo(TagFace::Ink ink) {
  return ink == TagFace::Ink::black ? Eigen::Array3f(26, 25, 25) : Eigen::Array3f(216, 217, 215);
}

Room::Room(const LabOptions& options)
    : floor_(options.seed),
      walls_(options.walls),
      things_(options.furniture ? furniture() : std::vector<Thing>{}),
      light_(makeLight(options)) {
  if (!(options.post_radius > 0 && options.post_height > kFootHeight))
    throw std::invalid_argument("posts need a radius and a height above 5 mm");
  addBoards(options);
  for (const LabTag& tag : options.tags)
    tags_.push_back({.face = TagFace(tag.id, tag.size),
                     .ball = {tag.T_world_tag.translation(), 0.93 * tag.size},
                     .T_tag_world = tag.T_world_tag.inverse()});
  for (const LabPost& post : options.posts) {
    const Eigen::Vector3d base =
        options.T_world_map * Eigen::Vector3d(post.p_map.x(), post.p_map.y(), 0);
    const double half = options.post_height / 2, foot = 2.2 * options.post_radius;
    posts_.push_back({.shaft = {.centre = {base.x(), base.y(), half},
                                .radius = options.post_radius,
                                .half_length = half},
                      .foot = {.centre = {base.x(), base.y(), kFootHeight / 2},
                               .radius = foot,
                               .half_length = kFootHeight / 2},
                      .ball = {{base.x(), base.y(), half}, 1.001 * std::hypot(half, foot)}});
  }
}

LightMap Room::makeLight(const LabOptions& options) {
  std::vector<Blocker> all = blockers(options);
  Eigen::Vector2d lower(-4.5, -3.5), upper(4.5, 3.5);
  for (const Blocker& blocker : all) {
    lower = lower.cwiseMin(blocker.p_world - Eigen::Vector2d::Constant(1));
    upper = upper.cwiseMax(blocker.p_world + Eigen::Vector2d::Constant(1));
  }
  return {lower, upper, all};
}

void Room::addBoards(const LabOptions& options) {
  constexpr double kHeight = 0.20, kHalfThickness = 0.01;  // m
  for (const LabBoard& board : options.boards) {
    const auto in_world = [&](const Eigen::Vector2d& p) -> Eigen::Vector2d {
      return (options.T_world_map * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
    };
    const Eigen::Vector2d from = in_world(board.from_map), to = in_world(board.to_map);
    const Eigen::Vector2d middle = (from + to) / 2, half((to - from).norm() / 2, kHalfThickness);
    const double yaw = std::atan2(to.y() - from.y(), to.x() - from.x());
    things_.push_back(
        {.shape = makeBox(middle, half, 0, kHeight, yaw),
         .ball = {{middle.x(), middle.y(), kHeight / 2},
                  1.001 * std::hypot(half.norm(), kHeight / 2)},
         .albedo = board.glossy ? Eigen::Array3f(206, 190, 170) : Eigen::Array3f(92, 132, 168)});
  }
}

std::vector<Room::Thing> Room::furniture() {
  std::vector<Thing> things;
  const auto add = [&](const Eigen::Vector2d& centre, const Eigen::Vector2d& half, double bottom,
                       double top, double yaw, const Eigen::Array3f& paint) {
    const Eigen::Vector3d middle(centre.x(), centre.y(), (bottom + top) / 2);
    things.push_back({.shape = makeBox(centre, half, bottom, top, yaw),
                      .ball = {middle, 1.001 * std::hypot(half.norm(), (top - bottom) / 2)},
                      .albedo = paint});
  };
  const Eigen::Array3f cardboard(104, 146, 184), packing_tape(128, 172, 206), crate(92, 104, 58);
  add({-3.02, 0.34}, {0.21, 0.29}, 0, 0.26, 0.10, cardboard);
  add({-3.02, 0.34}, {0.025, 0.29}, 0.26, 0.261, 0.10, packing_tape);
  add({-3.08, -0.16}, {0.17, 0.15}, 0, 0.20, -0.22, cardboard);
  add({-3.08, -0.16}, {0.17, 0.022}, 0.20, 0.201, -0.22, packing_tape);
  // An open crate: four walls and what lies in it.
  const Eigen::Vector2d at(3.04, -0.35);
  for (const double side : {-1.0, 1.0}) {
    add(at + Eigen::Vector2d(0.20 * side, 0), {0.012, 0.30}, 0, 0.22, 0, crate);
    add(at + Eigen::Vector2d(0, 0.288 * side), {0.20, 0.012}, 0, 0.22, 0, crate);
  }
  add(at, {0.19, 0.28}, 0, 0.05, 0, 0.55F * crate);
  add(at + Eigen::Vector2d(0.03, 0.06), {0.10, 0.13}, 0.05, 0.12, 0.4,
      Eigen::Array3f(70, 128, 168));
  add(at + Eigen::Vector2d(-0.05, -0.17), {0.06, 0.07}, 0.05, 0.15, -0.3,
      Eigen::Array3f(176, 178, 180));
  return things;
}

Room::Candidates Room::candidates(const Ray& ray_world, double spread) const {
  const auto pick = [&](const auto& all) {
    std::vector<std::size_t> picked;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].ball.mayBeHit(ray_world, spread)) picked.push_back(i);
    return picked;
  };
  return {.tags = pick(tags_), .posts = pick(posts_), .things = pick(things_)};
}

Sight Room::trace(const Ray& ray_world, const Candidates& candidates) const {
  Sight nearest;
  traceFloor(ray_world, nearest);
  if (walls_.x() > 0 && walls_.y() > 0) traceWalls(ray_world, nearest);
  traceTags(ray_world, candidates.tags, nearest);
  tracePosts(ray_world, candidates.posts, nearest);
  traceThings(ray_world, candidates.things, nearest);
  return nearest;
}

Eigen::Array3f Room::colour(const Ray& ray_world, const Sight& sight) const {
  if (sight.part < 0) return {178, 176, 172};  // the walls, far away
  const Eigen::Vector3d p = ray_world.at(sight.t);
  if (sight.part < kWalls) return floor_.at(p.head<2>()) * tint(light_.at(p.head<2>()));
  if (sight.part < kTags) return wallPaint(sight.part) * tint(openLight(p, sight.normal));
  if (sight.part < kPosts) {
    const bool white = (sight.part - kTags) % 2 == 1;
    const Light light =
        sight.normal.z() > 0.99 ? light_.at(p.head<2>()) : openLight(p, sight.normal);
    return albedo(white ? TagFace::Ink::white : TagFace::Ink::black) * tint(light);
  }
  if (sight.part < kThings) return postColour(p, sight);
  const auto& thing = things_[static_cast<std::size_t>(sight.part - kThings) / 8];
  return thing.albedo * tint(openLight(p, sight.normal));
}

bool Room::isSolid(int part) {
  return part >= kPosts;
}

double Room::distanceToSolids(const Ray& ray_world) const {
  double t = std::numeric_limits<double>::infinity();
  for (const Post& post : posts_)
    if (post.ball.mayBeHit(ray_world))
      t = std::min({t, intersect(ray_world, post.shaft).t, intersect(ray_world, post.foot).t});
  for (const Thing& thing : things_)
    if (thing.ball.mayBeHit(ray_world)) t = std::min(t, intersect(ray_world, thing.shape).t);
  return t;
}

void Room::traceFloor(const Ray& ray, Sight& nearest) {
  if (!(ray.origin.z() > 0 && ray.direction.z() < 0)) return;
  const double t = -ray.origin.z() / ray.direction.z();
  nearest = {.part = Floor::isTape(ray.at(t).head<2>()) ? kTape : kFloor, .t = t};
}

/// Seen from inside: the first wall or the ceiling on the ray's way out.
void Room::traceWalls(const Ray& ray, Sight& nearest) const {
  constexpr double kCeiling = 2.7, kSkirting = 0.08;  // m
  const Eigen::Vector3d upper(walls_.x(), walls_.y(), kCeiling);
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = ray.direction[axis];
    if (slope == 0 || (axis == 2 && slope < 0)) continue;
    const double side = slope > 0 ? 1 : -1;
    const double t = (side * upper[axis] - ray.origin[axis]) / slope;
    if (!(t > 0 && t < nearest.t)) continue;
    const bool skirting = axis < 2 && ray.at(t).z() < kSkirting;
    nearest = {.part = kWalls + 4 * axis + (side > 0 ? 2 : 0) + (skirting ? 1 : 0),
               .t = t,
               .normal = -side * Eigen::Vector3d::Unit(axis)};
  }
}

Eigen::Array3f Room::wallPaint(int part) {
  const bool skirting = (part - kWalls) % 2 == 1;
  return skirting ? Eigen::Array3f(96, 104, 112) : Eigen::Array3f(176, 186, 190);
}

void Room::traceTags(const Ray& ray, const std::vector<std::size_t>& of, Sight& nearest) const {
  for (const std::size_t i : of) {
    const TagFace::TagHit hit = tags_[i].face.intersect(tags_[i].T_tag_world * ray);
    // Paper lies on the floor without thickness: on a tie it is the paper that is seen.
    if (!hit || hit.t > nearest.t + 1e-6) continue;
    nearest = {.part = kTags + 2 * static_cast<int>(i) + (hit.ink == TagFace::Ink::white ? 1 : 0),
               .t = hit.t,
               .normal = tags_[i].T_tag_world.linear().row(2).transpose()};
  }
}

void Room::tracePosts(const Ray& ray, const std::vector<std::size_t>& of, Sight& nearest) const {
  for (const std::size_t i : of) {
    const int first = kPosts + 8 * static_cast<int>(i);
    const Hit foot = intersect(ray, posts_[i].foot);
    if (foot.t < nearest.t) nearest = {.part = first + kFoot, .t = foot.t, .normal = foot.normal};
    const Hit shaft = intersect(ray, posts_[i].shaft);
    if (shaft.t >= nearest.t) continue;
    const double from_top = 2 * posts_[i].shaft.half_length - ray.at(shaft.t).z();
    const bool cap = shaft.normal.z() > 0.5, band = !cap && from_top > 0.03 && from_top < 0.07;
    const int kind = cap ? kCap : band ? kBand : kShaft;
    nearest = {.part = first + kind, .t = shaft.t, .normal = shaft.normal};
  }
}

Eigen::Array3f Room::postColour(const Eigen::Vector3d& p_world, const Sight& sight) {
  const Eigen::Array3f light = tint(openLight(p_world, sight.normal));
  const int kind = (sight.part - kPosts) % 8;
  if (kind == kFoot) return Eigen::Array3f(52, 50, 48) * light;
  // Less light reaches the foot of a post than its top.
  const auto low = static_cast<float>(1 - 0.35 * std::exp(-p_world.z() / 0.04));
  const Eigen::Array3f paint = kind == kBand  ? Eigen::Array3f(40, 96, 226)
                               : kind == kCap ? Eigen::Array3f(225, 226, 224)
                                              : Eigen::Array3f(206, 208, 206);
  return paint * light * low;
}

void Room::traceThings(const Ray& ray, const std::vector<std::size_t>& of, Sight& nearest) const {
  for (const std::size_t i : of) {
    const Hit hit = intersect(ray, things_[i].shape);
    if (hit.t >= nearest.t) continue;
    nearest = {.part = kThings + 8 * static_cast<int>(i) + (hit.normal.z() > 0.5 ? 0 : 1),
               .t = hit.t,
               .normal = hit.normal};
  }
}

}  // namespace slamscope::tracking::lab
