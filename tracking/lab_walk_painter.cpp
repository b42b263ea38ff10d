// SPDX-License-Identifier: MIT
#include "tracking/lab_walk_painter.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "tracking/lab_lattice.hpp"
#include "tracking/lab_pixel.hpp"

namespace slamscope::tracking::lab {
namespace {

constexpr int kWalkBlock = 16;                                     // px
constexpr int kRobotParts = 2000000, kBystanderPart = 3000000;     // apart from the room's
constexpr double kBystanderHeight = 1.75, kBystanderRadius = 0.2;  // m
constexpr double kNearest = 0.4;                                   // of what a head looks at, m

void forEachRow(int count, const std::function<void(int)>& work) {
  cv::parallel_for_(cv::Range(0, count), [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) work(row);
  });
}

double angleOf(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

/// How far (rad) something may wander in the picture while a row is exposed.
double wandering(const WalkMotion& motion) {
  const double whole = motion.robot.exposure + motion.robot.readout;
  const double share = whole > 0 ? motion.robot.exposure / whole : 0;
  const Eigen::Isometry3d &first = motion.T_world_camera.front(),
                          &last = motion.T_world_camera.back();
  return share *
         (angleOf(first, last) + (first.translation() - last.translation()).norm() / kNearest);
}

bool sameposes(const std::vector<Eigen::Isometry3d>& a, const std::vector<Eigen::Isometry3d>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.matrix() == y.matrix(); });
}

}  // namespace

bool WalkMotion::operator==(const WalkMotion& other) const {
  return bystander == other.bystander && sameposes(T_world_camera, other.T_world_camera) &&
         sameposes(robot.T_world_robot, other.robot.T_world_robot);
}

struct WalkPainter::Scene {
  const WalkMotion& motion;
  std::vector<Eigen::Isometry3d> T_robot_world;
  Blocker blocker;
  std::optional<Cylinder> bystander;

  explicit Scene(const WalkMotion& of)
      : motion(of), blocker(Robot::blocker(of.robot.T_world_robot[of.robot.middle()])) {
    for (const Eigen::Isometry3d& T : motion.robot.T_world_robot)
      T_robot_world.push_back(T.inverse());
    if (!motion.bystander) return;
    bystander =
        Cylinder{.centre = {motion.bystander->x(), motion.bystander->y(), kBystanderHeight / 2},
                 .radius = kBystanderRadius,
                 .half_length = kBystanderHeight / 2};
  }
};

WalkPainter::WalkPainter(const CameraInfo& camera, const Room& room, const Robot& robot)
    : room_(room), robot_(robot), camera_(camera), lens_(camera) {}

/// What each block of pixels may see.
std::vector<Room::Candidates> WalkPainter::blocks(const WalkMotion& motion) const {
  const int across = lens_.width() / kWalkBlock + 1, down = lens_.height() / kWalkBlock + 1;
  std::vector<Room::Candidates> result(static_cast<std::size_t>(across) * down);
  const double more = wandering(motion) + 0.003;
  forEachRow(down, [&](int row) {
    const double place = (row + 0.5) * kWalkBlock / lens_.height();
    // Rows of one block are exposed one after the other, too.
    const auto first =
        motion.robot.at(std::max(0.0, place - 0.5 * kWalkBlock / lens_.height()), 0.5);
    const auto last =
        motion.robot.at(std::min(1.0, place + 0.5 * kWalkBlock / lens_.height()), 0.5);
    const double shear = angleOf(motion.T_world_camera[first], motion.T_world_camera[last]);
    const Eigen::Isometry3d& T = motion.T_world_camera[motion.robot.at(std::min(1.0, place), 0.5)];
    for (int column = 0; column < across; ++column) {
      const auto corner = [&](int c, int r) {
        return lens_.corner(std::min(lens_.width(), c), std::min(lens_.height(), r));
      };
      const Eigen::Vector3d upper = corner(column * kWalkBlock, row * kWalkBlock);
      const Eigen::Vector3d lower = corner((column + 1) * kWalkBlock, (row + 1) * kWalkBlock);
      result[static_cast<std::size_t>(row) * across + column] = room_.candidates(
          {T.translation(), T.linear() * (upper + lower)}, (lower - upper).norm() + more + shear);
    }
  });
  return result;
}

const Room::Candidates& WalkPainter::seen(const std::vector<Room::Candidates>& blocks, int column,
                                          int row) const {
  const int across = lens_.width() / kWalkBlock + 1;
  return blocks[static_cast<std::size_t>(row / kWalkBlock) * across + column / kWalkBlock];
}

/// What of the light on the floor the robot leaves.
Eigen::Array3f WalkPainter::robotsShadow(const Scene& scene, const Eigen::Vector2d& p) const {
  const double far = reach(scene.blocker);
  if ((p - scene.blocker.p_world).squaredNorm() > far * far) return Eigen::Array3f::Ones();
  const Light open = room_.light().at(p);
  return tint(open * passed(p, scene.blocker)) / tint(open);
}

Ray WalkPainter::rayOf(const Scene& scene, const Eigen::Vector3d& direction, std::size_t pose) {
  const Eigen::Isometry3d& T = scene.motion.T_world_camera[pose];
  return {T.translation(), T.linear() * direction};
}

Sight WalkPainter::trace(const Scene& scene, const Ray& ray, std::size_t pose,
                         const Room::Candidates& candidates) const {
  Sight nearest = room_.trace(ray, candidates);
  // The ray's parameter is the same in both frames.
  const Sight robot = robot_.trace(scene.T_robot_world[pose] * ray);
  if (robot.part >= 0 && robot.t < nearest.t) {
    nearest = robot;
    nearest.part += kRobotParts;
  }
  if (!scene.bystander) return nearest;
  const Hit hit = intersect(ray, *scene.bystander);
  if (hit.t >= nearest.t) return nearest;
  return {
      .part = kBystanderPart + (hit.normal.z() > 0.5 ? 1 : 0), .t = hit.t, .normal = hit.normal};
}

Eigen::Array3f WalkPainter::colour(const Scene& scene, const Ray& ray, std::size_t pose,
                                   const Sight& sight) const {
  const Eigen::Vector3d p = ray.at(std::min(sight.t, 1e3));
  if (sight.part >= kBystanderPart)
    return Eigen::Array3f(92, 70, 62) * tint(openLight(p, sight.normal));
  if (sight.part >= kRobotParts) {
    Sight robot = sight;
    robot.part -= kRobotParts;
    return robot_.colour(scene.T_robot_world[pose] * ray, robot,
                         scene.motion.robot.T_world_robot[pose]);
  }
  const Eigen::Array3f room = room_.colour(ray, sight);
  return std::abs(p.z()) < 1e-6 ? room * robotsShadow(scene, p.head<2>()) : room;
}

int WalkPainter::blurPixels(const WalkMotion& motion) const {
  double radians = wandering(motion);
  const auto& robot = motion.robot.T_world_robot;
  radians += (robot.front().translation() - robot.back().translation()).norm() / kNearest;
  return static_cast<int>(std::ceil(std::max(0.0, camera_.K(0, 0) * radians / 2 - 0.5)));
}

Canvas WalkPainter::paint(const WalkMotion& motion) const {
  const Scene scene(motion);
  const int width = lens_.width(), height = lens_.height();
  const auto candidates = blocks(motion);
  struct Corner {
    int part;
    Eigen::Array3f colour;
  };
  std::vector<Corner> corners(static_cast<std::size_t>(width + 1) * (height + 1));
  forEachRow(height + 1, [&](int row) {
    const std::size_t pose = motion.robot.at(static_cast<double>(row) / height, 0.5);
    for (int column = 0; column <= width; ++column) {
      const Ray ray = rayOf(scene, lens_.corner(column, row), pose);
      const Sight sight = trace(scene, ray, pose, seen(candidates, column, row));
      corners[static_cast<std::size_t>(row) * (width + 1) + column] = {
          .part = sight.part, .colour = colour(scene, ray, pose, sight)};
    }
  });
  // Pixels that an edge crosses, and those that it may reach during the exposure.
  cv::Mat edges(height, width, CV_8U, cv::Scalar(0));
  const auto at = [&](int column, int row) {
    return &corners[static_cast<std::size_t>(row) * (width + 1) + column];
  };
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const Corner *a = at(column, row), *b = at(column, row + 1);
      const bool even = a[0].part == a[1].part && b[0].part == b[1].part && a[0].part == b[0].part;
      edges.at<std::uint8_t>(row, column) = even ? 0 : 1;
    }
  const int around = 2 * (1 + blurPixels(motion)) + 1;
  cv::dilate(edges, edges, cv::getStructuringElement(cv::MORPH_RECT, cv::Size(around, around)));
  Canvas canvas{.width = width, .height = height, .pixels = {}};
  canvas.pixels.resize(static_cast<std::size_t>(width) * height);
  forEachRow(height, [&](int row) {
    const double place = (row + 0.5) / height;
    for (int column = 0; column < width; ++column) {
      const Corner *a = at(column, row), *b = at(column, row + 1);
      if (edges.at<std::uint8_t>(row, column) == 0) {
        canvas.at(column, row) = 0.25F * (a[0].colour + a[1].colour + b[0].colour + b[1].colour);
        continue;
      }
      PixelMean pixel;
      for (const LatticePoint& p : kQuick) {
        const std::size_t pose = motion.robot.at(place, p.moment);
        const Ray ray = rayOf(scene, lens_.direction(column, row, p.x, p.y), pose);
        const Sight sight = trace(scene, ray, pose, seen(candidates, column, row));
        pixel.add(sight.part, [&] { return colour(scene, ray, pose, sight); });
      }
      canvas.at(column, row) = pixel.mean();
    }
  });
  return canvas;
}

}  // namespace slamscope::tracking::lab
