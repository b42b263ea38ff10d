// SPDX-License-Identifier: MIT
#include "slam/laser_front_end.hpp"

#include <cmath>
#include <stdexcept>

namespace slamscope::slam {

Eigen::Vector2d readingFromRobot(const Eigen::Vector3d& pose_robot, const Eigen::Vector2d& z,
                                 Eigen::Matrix2d* J) {
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix2d dp_dz;
  const Eigen::Vector2d p_robot =
      locateFeature(Sensor::range_bearing, pose_robot, z, nullptr, J == nullptr ? nullptr : &dp_dz);
  if (J != nullptr) *J = observeJacobians(Sensor::range_bearing, origin, p_robot).H_f * dp_dz;
  return observeFeature(Sensor::range_bearing, origin, p_robot);
}

LaserFrontEnd::LaserFrontEnd(const LaserMount& mount, const LaserPointOptions& options)
    : mount_(mount), options_(options) {
  if (!mount.pose_robot.allFinite() || !(mount.sweep >= 0.0) || !(options.min_range >= 0.0) ||
      !(options.max_range > options.min_range) || !(options.max_diameter > 0.0) ||
      !(options.gap > 0.0) || !(options.range_sigma > 0.0) || !(options.shape_sigma >= 0.0)) {
    throw std::invalid_argument(
        "a laser needs a finite pose, a sweep of 0 s or more, max range above min range, and "
        "diameter, gap and range sigma above 0");
  }
}

std::vector<Observation> LaserFrontEnd::observations(const LaserScan& scan,
                                                     const Eigen::Vector2d& velocity) const {
  std::vector<Observation> result;
  const double per_return =
      scan.ranges.size() > 1 ? mount_.sweep / static_cast<double>(scan.ranges.size() - 1) : 0.0;
  for (const LaserPoint& point : findPoints(scan, options_)) {
    const double delay = per_return * 0.5 * static_cast<double>(point.first + point.last);
    const Eigen::Vector3d moved = arcIncrement(velocity, delay);
    Observation o;
    Eigen::Matrix2d J;
    o.z = readingFromRobot(movePose(moved, mount_.pose_robot), point.z, &J);
    o.R = J * point.R * J.transpose();
    if (o.z.allFinite() && o.R.allFinite()) result.push_back(o);
  }
  return result;
}

MapBuilder::View LaserFrontEnd::view(const LaserScan& scan) const {
  return [this, &scan](const Eigen::Vector2d& z, const Eigen::Matrix2d& S) {
    const Eigen::Vector2d p_robot =
        locateFeature(Sensor::range_bearing, Eigen::Vector3d::Zero(), z);
    const Eigen::Vector2d at_laser =
        observeFeature(Sensor::range_bearing, mount_.pose_robot, p_robot);
    const double across = std::sqrt(S(1, 1)) * z[0] / at_laser[0];  // seen from the laser
    return seesPast(scan, options_, at_laser[0], at_laser[1],
                    options_.clearance + 2.0 * std::sqrt(S(0, 0)), 2.0 * across);
  };
}

}  // namespace slamscope::slam
