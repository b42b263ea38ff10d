// SPDX-License-Identifier: MIT
#include "tracking/lab_painter.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>
#include <span>

#include "tracking/lab_lattice.hpp"
#include "tracking/lab_pixel.hpp"

namespace slamscope::tracking::lab {
namespace {

constexpr int kBlock = 16;  // px

void forRows(int first, int last, const std::function<void(int)>& work) {
  cv::parallel_for_(cv::Range(first, last), [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) work(row);
  });
}

}  // namespace

Region Region::grown(int by, int width, int height) const {
  return {std::max(0, left - by), std::max(0, top - by), std::min(width, right + by),
          std::min(height, bottom + by)};
}

std::size_t Motion::at(double row, double moment) const {
  const double whole = exposure + readout;
  if (T_world_robot.size() == 1 || whole <= 0) return 0;
  const double part = (row * readout + moment * exposure) / whole;
  const double last = static_cast<double>(T_world_robot.size() - 1);
  return static_cast<std::size_t>(std::lround(part * last));
}

struct Painter::Corner {
  int part;
  Eigen::Array3f colour;
};

/// What is seen through the corners of a region's pixels.
struct Painter::Corners {
  Region region;
  std::vector<Corner> samples;  // one more than pixels, both ways

  [[nodiscard]] const Corner& at(int column, int row) const {
    const int width = region.right - region.left + 1;
    return samples[static_cast<std::size_t>(row - region.top) * width + (column - region.left)];
  }
  /// The same part all over the pixel and `around` more pixels on each side.
  [[nodiscard]] bool uniform(int column, int row, int around) const {
    const int part = at(column, row).part;
    for (int r = std::max(region.top, row - around); r <= std::min(region.bottom, row + 1 + around);
         ++r)
      for (int c = std::max(region.left, column - around);
           c <= std::min(region.right, column + 1 + around); ++c)
        if (at(c, r).part != part) return false;
    return true;
  }
  [[nodiscard]] Eigen::Array3f mean(int column, int row) const {
    return 0.25F * (at(column, row).colour + at(column + 1, row).colour +
                    at(column, row + 1).colour + at(column + 1, row + 1).colour);
  }
};

/// A motion, ready for rays of the camera.
struct Painter::Exposure {
  const Motion& motion;
  std::vector<Eigen::Isometry3d> T_robot_camera;

  Exposure(const Motion& of, const Eigen::Isometry3d& T_world_camera) : motion(of) {
    for (const Eigen::Isometry3d& T_world_robot : motion.T_world_robot)
      T_robot_camera.push_back(T_world_robot.inverse() * T_world_camera);
  }
};

Painter::Painter(const LabOptions& options, const Room& room, const Robot& robot)
    : room_(room),
      robot_(robot),
      camera_(options.camera),
      lens_(options.camera),
      T_world_camera_(options.T_world_camera) {
  paintBackground();
}

Painter::Corners Painter::traceCorners(const Region& region,
                                       const std::function<Corner(int, int)>& trace) {
  const int width = region.right - region.left + 1, height = region.bottom - region.top + 1;
  Corners corners{.region = region, .samples = {}};
  corners.samples.resize(static_cast<std::size_t>(width) * height);
  forRows(0, height, [&](int row) {
    for (int column = 0; column < width; ++column)
      corners.samples[static_cast<std::size_t>(row) * width + column] =
          trace(region.left + column, region.top + row);
  });
  return corners;
}

Eigen::Array3f Painter::sampleRoom(int column, int row, const Room::Candidates& of) const {
  PixelMean pixel;
  for (const LatticePoint& p : kFine) {
    const Ray ray = rayInWorld(lens_.direction(column, row, p.x, p.y));
    const Sight sight = room_.trace(ray, of);
    pixel.add(sight.part, [&] { return room_.colour(ray, sight); });
  }
  return pixel.mean();
}

void Painter::paintBackground() {
  const Region all{0, 0, lens_.width(), lens_.height()};
  // What each block of pixels may see.
  const int across = all.right / kBlock + 1, down = all.bottom / kBlock + 1;
  std::vector<Room::Candidates> blocks(static_cast<std::size_t>(across) * down);
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column) {
      const auto corner = [&](int c, int r) {
        return lens_.corner(std::min(all.right, c), std::min(all.bottom, r));
      };
      const Eigen::Vector3d first = corner(column * kBlock, row * kBlock);
      const Eigen::Vector3d last = corner((column + 1) * kBlock, (row + 1) * kBlock);
      blocks[static_cast<std::size_t>(row) * across + column] =
          room_.candidates(rayInWorld(first + last), (last - first).norm());
    }
  const auto seen = [&](int column, int row) -> const Room::Candidates& {
    return blocks[static_cast<std::size_t>(row / kBlock) * across + column / kBlock];
  };
  const Corners corners = traceCorners(all, [&](int column, int row) {
    const Ray ray = rayInWorld(lens_.corner(column, row));
    const Sight sight = room_.trace(ray, seen(column, row));
    return Corner{.part = sight.part, .colour = room_.colour(ray, sight)};
  });
  background_ = {.width = all.right, .height = all.bottom, .pixels = {}};
  background_.pixels.resize(static_cast<std::size_t>(all.right) * all.bottom);
  forRows(0, all.bottom, [&](int row) {
    for (int column = 0; column < all.right; ++column)
      background_.at(column, row) = corners.uniform(column, row, 1)
                                        ? corners.mean(column, row)
                                        : sampleRoom(column, row, seen(column, row));
  });
  solids_.reserve(corners.samples.size());
  for (const Corner& corner : corners.samples) solids_.push_back(Room::isSolid(corner.part));
}

bool Painter::solidsNear(int column, int row) const {
  for (int r = std::max(0, row - 1); r <= std::min(lens_.height(), row + 2); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(lens_.width(), column + 2); ++c)
      if (solids_[static_cast<std::size_t>(r) * (lens_.width() + 1) + c]) return true;
  return false;
}

Ray Painter::rayInRobot(const Eigen::Vector3d& direction, const Exposure& exposure,
                        std::size_t pose) {
  const Eigen::Isometry3d& T_robot_camera = exposure.T_robot_camera[pose];
  return {T_robot_camera.translation(), T_robot_camera.linear() * direction};
}

Sight Painter::traceRobot(const Eigen::Vector3d& direction, const Exposure& exposure,
                          std::size_t pose, bool solids) const {
  const Sight sight = robot_.trace(rayInRobot(direction, exposure, pose));
  // The ray's parameter is the same in both frames.
  if (solids && sight.part >= 0 && room_.distanceToSolids(rayInWorld(direction)) < sight.t)
    return {};
  return sight;
}

Eigen::Array3f Painter::robotsColour(const Eigen::Vector3d& direction, const Exposure& exposure,
                                     std::size_t pose, const Sight& sight) const {
  return robot_.colour(rayInRobot(direction, exposure, pose), sight,
                       exposure.motion.T_world_robot[pose]);
}

Eigen::Array3f Painter::sampleRobot(int column, int row, const Exposure& exposure,
                                    const Eigen::Array3f& behind) const {
  const bool rests = exposure.motion.T_world_robot.size() == 1;
  const std::span<const LatticePoint> lattice =
      rests ? std::span<const LatticePoint>(kFine) : std::span<const LatticePoint>(kQuick);
  const double place = (row + 0.5) / lens_.height();
  const bool solids = solidsNear(column, row);
  PixelMean pixel;
  for (const LatticePoint& p : lattice) {
    const Eigen::Vector3d direction = lens_.direction(column, row, p.x, p.y);
    const std::size_t pose = exposure.motion.at(place, p.moment);
    const Sight sight = traceRobot(direction, exposure, pose, solids);
    pixel.add(sight.part, [&]() -> Eigen::Array3f {
      return sight.part < 0 ? behind : robotsColour(direction, exposure, pose, sight);
    });
  }
  return pixel.mean();
}

/// How much of the light on the floor a blocker leaves, seen through the upper left corner of a
/// pixel.
Eigen::Array3f Painter::shade(int column, int row, const Blocker& blocker) const {
  const Ray ray = rayInWorld(lens_.corner(column, row));
  if (!(ray.direction.z() < 0)) return Eigen::Array3f::Ones();
  const Eigen::Vector2d p = ray.at(-ray.origin.z() / ray.direction.z()).head<2>();
  if ((p - blocker.p_world).squaredNorm() > reach(blocker) * reach(blocker))
    return Eigen::Array3f::Ones();
  const Light open = room_.light().at(p);
  return tint(open * passed(p, blocker)) / tint(open);
}

/// Darkens a region by the robot's shadow: taken at every other corner, and evenly in between.
void Painter::paintShadow(Canvas& canvas, const Region& region, const Blocker& blocker) const {
  forRows(0, (region.bottom - region.top + 1) / 2, [&](int pair) {
    const int row = region.top + 2 * pair, below = std::min(row + 2, region.bottom);
    Eigen::Array3f a = shade(region.left, row, blocker), b = shade(region.left, below, blocker);
    for (int column = region.left; column < region.right; column += 2) {
      const int beside = std::min(column + 2, region.right);
      const Eigen::Array3f c = shade(beside, row, blocker), d = shade(beside, below, blocker);
      for (int y = row; y < below; ++y)
        for (int x = column; x < beside; ++x) {
          const float fx =
              (static_cast<float>(x - column) + 0.5F) / static_cast<float>(beside - column);
          const float fy = (static_cast<float>(y - row) + 0.5F) / static_cast<float>(below - row);
          canvas.at(x, y) *= (1 - fy) * ((1 - fx) * a + fx * c) + fy * ((1 - fx) * b + fx * d);
        }
      a = c;
      b = d;
    }
  });
}

/// How many pixels the robot moves while it is exposed, at most.
int Painter::blurPixels(const Motion& motion) const {
  if (motion.T_world_robot.size() == 1) return 0;
  double most = 0;
  for (const Eigen::Vector3d& p_robot : robot_.bounds()) {
    const Eigen::Vector3d first = motion.T_world_robot.front() * p_robot;
    const Eigen::Vector3d last = motion.T_world_robot.back() * p_robot;
    const double depth = (T_world_camera_.inverse() * first).z();
    if (depth > 0.05) most = std::max(most, camera_.K(0, 0) * (last - first).norm() / depth);
  }
  const double share = motion.exposure / (motion.exposure + motion.readout);  // of one row
  // The pixel beside is looked at anyway.
  return static_cast<int>(std::ceil(std::max(0.0, most * share / 2 - 0.5)));
}

Region Painter::changed(const Motion& motion) const {
  const Eigen::Isometry3d T_camera_world = T_world_camera_.inverse();
  std::vector<Eigen::Vector3d> seen;
  const auto add = [&](const Eigen::Vector3d& p_world) {
    seen.push_back(T_camera_world * p_world);
  };
  for (const Eigen::Isometry3d* T : {&motion.T_world_robot.front(), &motion.T_world_robot.back()}) {
    for (const Eigen::Vector3d& p_robot : robot_.bounds()) add(*T * p_robot);
    const Blocker blocker = Robot::blocker(*T);
    for (int i = 0; i < 16; ++i) {
      const double angle = i * std::numbers::pi / 8, radius = 1.02 * reach(blocker);
      add({blocker.p_world.x() + radius * std::cos(angle),
           blocker.p_world.y() + radius * std::sin(angle), 0});
    }
  }
  const Region all{0, 0, lens_.width(), lens_.height()};
  for (const Eigen::Vector3d& p : seen)
    if (p.z() < 0.05 || p.head<2>().norm() > 1.5 * p.z() * lens_.width() / camera_.K(0, 0))
      return all;
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
  for (const Eigen::Vector2d& pixel : projectByOpenCv(camera_, seen)) {
    left = std::min(left, pixel.x());
    right = std::max(right, pixel.x());
    top = std::min(top, pixel.y());
    bottom = std::max(bottom, pixel.y());
  }
  const auto inside = [](double v, int size) {
    return static_cast<int>(std::clamp(v, 0.0, 1.0 * size));
  };
  return {inside(left - 3, all.right), inside(top - 3, all.bottom), inside(right + 4, all.right),
          inside(bottom + 4, all.bottom)};
}

void Painter::paintRobot(Canvas& canvas, const Region& region, const Motion& motion) const {
  if (region.empty()) return;
  const Exposure exposure(motion, T_world_camera_);
  const Corners corners = traceCorners(region, [&](int column, int row) {
    const std::size_t pose = motion.at(static_cast<double>(row) / lens_.height(), 0.5);
    const Eigen::Vector3d direction = lens_.corner(column, row);
    const Sight sight = traceRobot(direction, exposure, pose, solidsNear(column, row));
    Corner corner{.part = sight.part, .colour = Eigen::Array3f::Zero()};
    if (sight.part >= 0) corner.colour = robotsColour(direction, exposure, pose, sight);
    return corner;
  });
  paintShadow(canvas, region, Robot::blocker(motion.T_world_robot[motion.middle()]));
  const int around = 1 + blurPixels(motion);
  forRows(region.top, region.bottom, [&](int row) {
    for (int column = region.left; column < region.right; ++column) {
      const bool uniform = corners.uniform(column, row, around);
      if (!uniform)
        canvas.at(column, row) = sampleRobot(column, row, exposure, canvas.at(column, row));
      else if (corners.at(column, row).part >= 0)
        canvas.at(column, row) = corners.mean(column, row);
    }
  });
}

}  // namespace slamscope::tracking::lab
