// SPDX-License-Identifier: MIT
#include "slam/laser_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace slamscope::slam {
namespace {

class PointFinder {
 public:
  PointFinder(const LaserScan& scan, const LaserPointOptions& options)
      : scan_(scan), options_(options) {}

  std::vector<LaserPoint> find() const {
    std::vector<LaserPoint> points;
    const std::size_t count = scan_.ranges.size();
    for (std::size_t first = 0; first < count; ++first) {
      if (!belongs(first)) continue;
      std::size_t last = first;
      while (last + 1 < count && belongs(last + 1) &&
             std::abs(scan_.ranges[last + 1] - scan_.ranges[last]) <= options_.gap) {
        ++last;
      }
      if (const auto point = pointOf(first, last)) points.push_back(*point);
      first = last;
    }
    return points;
  }

 private:
  bool returned(std::size_t k) const {
    const double range = scan_.ranges[k];
    return range >= options_.min_range && range < options_.max_range;  // NaN is neither
  }

  /// Whether return k can be part of a feature.
  bool belongs(std::size_t k) const {
    if (!returned(k) || !options_.reflector_intensity) return returned(k);
    return k < scan_.intensities.size() && scan_.intensities[k] >= *options_.reflector_intensity;
  }

  /// Whether the return beside a group leaves the group standing free.
  bool clear(std::size_t beside, double range) const {
    return !returned(beside) || scan_.ranges[beside] > range + options_.clearance;
  }

  std::optional<LaserPoint> pointOf(std::size_t first, std::size_t last) const {
    const auto count = static_cast<double>(last - first + 1);
    if (count < options_.fewest_returns) return std::nullopt;
    const bool at_edge = first == 0 || last + 1 == scan_.ranges.size();  // it may go on
    if (at_edge && !options_.reflector_intensity) return std::nullopt;
    const auto begin = scan_.ranges.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = scan_.ranges.begin() + static_cast<std::ptrdiff_t>(last) + 1;
    const auto [nearest, farthest] = std::minmax_element(begin, end);
    double mean = 0.0;
    for (auto range = begin; range != end; ++range) mean += *range / count;
    const double width_of_return = mean * std::abs(scan_.angle_step);
    LaserPoint point;
    point.diameter = count * width_of_return;
    point.first = first;
    point.last = last;
    if (!options_.reflector_intensity) {
      if (!clear(first - 1, scan_.ranges[first]) || !clear(last + 1, scan_.ranges[last])) {
        return std::nullopt;
      }
      // One return more or less may be missing of a thing that is just small enough.
      if (point.diameter > options_.max_diameter + width_of_return ||
          point.diameter < options_.min_diameter - width_of_return) {
        return std::nullopt;
      }
      if (*farthest - *nearest > 0.5 * point.diameter + 6.0 * options_.range_sigma) {
        return std::nullopt;  // deeper than the visible side of a disc: a wall seen aslant
      }
    }
    setReading(point, mean, count);
    return point;
  }

  void setReading(LaserPoint& point, double mean, double count) const {
    constexpr double kDepth = std::numbers::pi / 8.0;  // of the centre, by the diameter
    const double step = std::abs(scan_.angle_step);
    const double edges = step * step / 24.0;  // the mean of two that are uniform over a step
    const double shape = options_.shape_sigma * options_.shape_sigma;
    point.z = {mean + kDepth * point.diameter,
               0.5 * (scan_.angle(point.first) + scan_.angle(point.last))};
    // The diameter is the difference of the two edges: four times the variance of their mean.
    const double diameter = 4.0 * edges * mean * mean;
    // Over the visible side of a disc the depth has a variance of 0.05 radii squared.
    const double depth = 0.05 * 0.25 * point.diameter * point.diameter / count;
    point.R(0, 0) = options_.range_sigma * options_.range_sigma / count + depth +
                    kDepth * kDepth * diameter + shape;
    point.R(1, 1) = edges + shape / (point.z[0] * point.z[0]);
  }

  const LaserScan& scan_;
  const LaserPointOptions& options_;
};

}  // namespace

std::vector<LaserPoint> findPoints(const LaserScan& scan, const LaserPointOptions& options) {
  return PointFinder(scan, options).find();
}

bool seesPast(const LaserScan& scan, const LaserPointOptions& options, double range, double bearing,
              double margin_range, double margin_bearing) {
  if (!(range < options.max_range) || scan.ranges.empty() || scan.angle_step == 0.0) return false;
  const double middle = (bearing - scan.angle_min) / scan.angle_step;
  const double reach = 1.0 + margin_bearing / std::abs(scan.angle_step);
  const double first = std::floor(middle - reach);
  const double last = std::ceil(middle + reach);
  if (!(first >= 0.0) || !(last < static_cast<double>(scan.ranges.size()))) return false;
  for (auto k = static_cast<std::size_t>(first); k <= static_cast<std::size_t>(last); ++k) {
    if (scan.ranges[k] < range + margin_range && scan.ranges[k] >= options.min_range) return false;
  }
  return true;
}

}  // namespace slamscope::slam
