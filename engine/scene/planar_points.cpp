// SPDX-License-Identifier: MIT
#include "engine/scene/planar_points.hpp"

#include <numeric>
#include <stdexcept>
#include <string>

namespace slamscope::engine {

PlanarPoints::PlanarPoints(std::span<const Eigen::Vector2d> means, std::span<const double> packed,
                           int first_row, std::span<const std::uint64_t> names)
    : names_(names.begin(), names.end()) {
  const std::size_t n = means.size();
  const auto first = static_cast<std::size_t>(first_row);
  const std::size_t rows = first + 2 * n;
  if (first_row < 0 || packed.size() < rows * (rows + 1) / 2) {
    throw std::invalid_argument("the covariance of " + std::to_string(n) + " points from row " +
                                std::to_string(first_row) + " on needs " +
                                std::to_string(rows * (rows + 1) / 2) + " numbers, not " +
                                std::to_string(packed.size()));
  }
  if (!names.empty() && names.size() != n) {
    throw std::invalid_argument(std::to_string(n) + " points need a name each, not " +
                                std::to_string(names.size()));
  }
  names_.resize(n);
  if (names.empty()) std::iota(names_.begin(), names_.end(), std::uint64_t{0});
  if (n == 0) return;
  const auto row = [packed](std::size_t r) { return packed.data() + r * (r + 1) / 2; };
  origin_ = means.front();
  for (const Eigen::Vector2d& mean : means) means_.push_back((mean - origin_).cast<float>());

  const double xx = row(first)[first];
  const double yx = row(first + 1)[first];
  const double yy = row(first + 1)[first + 1];
  blocks_.resize(n * (n + 1) / 2);
  Eigen::Vector4f* out = blocks_.data();
  for (std::size_t j = 0; j < n; ++j) {
    const double* x = row(first + 2 * j) + first;
    const double* y = row(first + 2 * j + 1) + first;
    for (std::size_t i = 0; i < 2 * j; i += 2) {
      *out++ = {static_cast<float>(x[i] - xx), static_cast<float>(x[i + 1] - yx),
                static_cast<float>(y[i] - yx), static_cast<float>(y[i + 1] - yy)};
    }
    // The upper triangle's entry of the diagonal block is the lower one's.
    const auto off = static_cast<float>(y[2 * j] - yx);
    *out++ = {static_cast<float>(x[2 * j] - xx), off, off, static_cast<float>(y[2 * j + 1] - yy)};
  }
}

}  // namespace slamscope::engine
