// SPDX-License-Identifier: MIT
#include "tracking/lab_painter.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>

namespace slamscope::tracking::lab {
namespace {

constexpr int kSamples = 97;

/// Place in the pixel and moment of the exposure, each 0..1.
struct LatticePoint {
  double x, y, moment;
};

/// A Korobov lattice: 97 different columns, rows and moments, evenly spread also together, so that
/// an edge of any direction is placed to 1/194 px or better (a 10 × 10 grid misplaces an edge along
/// its own axes by up to 1/20 px).
constexpr std::array<LatticePoint, kSamples> kLattice = [] {
  std::array<LatticePoint, kSamples> points{};
  for (int i = 0; i < kSamples; ++i)
    points[i] = {(i + 0.5) / kSamples, (i * 52 % kSamples + 0.5) / kSamples,
                 (i * 85 % kSamples + 0.5) / kSamples};
  return points;
}();

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

const Eigen::Isometry3d& Motion::at(double row, double moment) const {
  const double whole = exposure + readout;
  if (T_world_robot.size() == 1 || whole <= 0) return T_world_robot.front();
  const double part = (row * readout + moment * exposure) / whole;
  const double last = static_cast<double>(T_world_robot.size() - 1);
  return T_world_robot[static_cast<std::size_t>(std::lround(part * last))];
}

/// What is seen through the corners of a region's pixels.
struct Painter::Corners {
  Region region;
  std::vector<Sample> samples;  // one more than pixels, both ways

  [[nodiscard]] const Sample& at(int column, int row) const {
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

Painter::Painter(const LabOptions& options, const Room& room, const Robot& robot)
    : room_(room),
      robot_(robot),
      camera_(options.camera),
      lens_(options.camera),
      T_world_camera_(options.T_world_camera) {}

Painter::Corners Painter::traceCorners(const Region& region,
                                       const std::function<Sample(const Ray&)>& trace) const {
  const int width = region.right - region.left + 1, height = region.bottom - region.top + 1;
  Corners corners{.region = region,
                  .samples = std::vector<Sample>(static_cast<std::size_t>(width) * height)};
  forRows(0, height, [&](int row) {
    for (int column = 0; column < width; ++column)
      corners.samples[static_cast<std::size_t>(row) * width + column] =
          trace(rayInWorld(lens_.corner(region.left + column, region.top + row)));
  });
  return corners;
}

Eigen::Array3f Painter::sampleRoom(int column, int row) const {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (const LatticePoint& p : kLattice)
    sum += room_.trace(rayInWorld(lens_.direction(column, row, p.x, p.y))).colour;
  return sum / kSamples;
}

Canvas Painter::background() const {
  const Region all{0, 0, lens_.width(), lens_.height()};
  const Corners corners = traceCorners(all, [this](const Ray& ray) { return room_.trace(ray); });
  Canvas canvas{.width = all.right, .height = all.bottom, .pixels = {}};
  canvas.pixels.resize(static_cast<std::size_t>(all.right) * all.bottom);
  forRows(0, all.bottom, [&](int row) {
    for (int column = 0; column < all.right; ++column)
      canvas.at(column, row) =
          corners.uniform(column, row, 1) ? corners.mean(column, row) : sampleRoom(column, row);
  });
  return canvas;
}

Sample Painter::traceRobot(const Ray& ray_world, const Eigen::Isometry3d& T_world_robot) const {
  const Sample sample = robot_.trace(T_world_robot.inverse() * ray_world, T_world_robot);
  // The ray's parameter is the same in both frames.
  if (sample.part >= 0 && room_.distanceToSolids(ray_world) < sample.t) return {};
  return sample;
}

Eigen::Array3f Painter::sampleRobot(int column, int row, const Motion& motion,
                                    const Eigen::Array3f& behind) const {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  int missed = 0;
  const double place = (row + 0.5) / lens_.height();
  for (const LatticePoint& p : kLattice) {
    const Sample sample =
        traceRobot(rayInWorld(lens_.direction(column, row, p.x, p.y)), motion.at(place, p.moment));
    if (sample.part < 0)
      ++missed;
    else
      sum += sample.colour;
  }
  return (sum + static_cast<float>(missed) * behind) / kSamples;
}

Eigen::Array3f Painter::shaded(int column, int row, const Eigen::Array3f& colour,
                               const Blocker& blocker) const {
  const Ray ray = rayInWorld(lens_.direction(column, row, 0.5, 0.5));
  if (!(ray.direction.z() < 0)) return colour;
  const Eigen::Vector2d p = ray.at(-ray.origin.z() / ray.direction.z()).head<2>();
  if ((p - blocker.p_world).squaredNorm() > reach(blocker) * reach(blocker)) return colour;
  const Light open = room_.light().at(p);
  return colour * tint(open * passed(p, blocker)) / tint(open);
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
  return static_cast<int>(std::ceil(most / 2));
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
  const Corners corners =
      traceCorners(region, [&](const Ray& ray) { return traceRobot(ray, motion.middle()); });
  const Blocker blocker = Robot::blocker(motion.middle());
  const int around = 1 + blurPixels(motion);
  forRows(region.top, region.bottom, [&](int row) {
    for (int column = region.left; column < region.right; ++column) {
      const bool uniform = corners.uniform(column, row, around);
      Eigen::Array3f& pixel = canvas.at(column, row);
      if (uniform && corners.at(column, row).part >= 0) {
        pixel = corners.mean(column, row);
        continue;
      }
      pixel = shaded(column, row, pixel, blocker);
      if (!uniform) pixel = sampleRobot(column, row, motion, pixel);
    }
  });
}

}  // namespace slamscope::tracking::lab
