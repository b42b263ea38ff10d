// SPDX-License-Identifier: MIT
#include "slam/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace slamscope::slam {
namespace {

std::size_t packedSize(int size) {
  return static_cast<std::size_t>(size) * (static_cast<std::size_t>(size) + 1) / 2;
}

}  // namespace

PackedCovariance::PackedCovariance(int size) : size_(size), packed_(packedSize(size), 0.0) {}

PackedCovariance::PackedCovariance(int size, std::vector<double> packed)
    : size_(size), packed_(std::move(packed)) {
  if (packed_.size() != packedSize(size)) {
    throw std::invalid_argument("packed covariance of size " + std::to_string(size) + " needs " +
                                std::to_string(packedSize(size)) + " numbers, got " +
                                std::to_string(packed_.size()));
  }
}

PackedCovariance PackedCovariance::fromLower(const Eigen::Ref<const Eigen::MatrixXd>& P) {
  PackedCovariance result(static_cast<int>(P.rows()));
  std::size_t k = 0;
  for (int row = 0; row < P.rows(); ++row) {
    for (int col = 0; col <= row; ++col) result.packed_[k++] = P(row, col);
  }
  return result;
}

PackedCovariance PackedCovariance::fromFull(int size, std::span<const double> full,
                                            double& asymmetry) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<double> packed;
  packed.reserve(packedSize(size));
  asymmetry = 0.0;
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t col = 0; col <= row; ++col) {
      const double below = full[row * n + col];
      const double above = full[col * n + row];
      packed.push_back(below);
      if (std::isnan(below) != std::isnan(above)) {
        asymmetry = std::numeric_limits<double>::infinity();
      } else if (below != above && std::abs(below - above) > asymmetry) {
        asymmetry = std::abs(below - above);
      }
    }
  }
  return {size, std::move(packed)};
}

Eigen::Matrix2d PackedCovariance::block2(int row, int col) const {
  const PackedCovariance& P = *this;
  Eigen::Matrix2d block;
  block << P(row, col), P(row, col + 1), P(row + 1, col), P(row + 1, col + 1);
  return block;
}

Eigen::MatrixXd PackedCovariance::dense() const {
  Eigen::MatrixXd P(size_, size_);
  std::size_t k = 0;
  for (int row = 0; row < size_; ++row) {
    for (int col = 0; col <= row; ++col) P(row, col) = P(col, row) = packed_[k++];
  }
  return P;
}

std::optional<int> Snapshot::indexOf(FeatureId id) const {
  const auto found = std::find(ids.begin(), ids.end(), id);
  if (found == ids.end()) return std::nullopt;
  return static_cast<int>(found - ids.begin());
}

Eigen::Matrix3d Snapshot::poseCovariance() const {
  Eigen::Matrix3d P_vv;
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) P_vv(row, col) = covariance(row, col);
  }
  return P_vv;
}

bool Snapshot::finite() const {
  const auto finite_number = [](double value) { return std::isfinite(value); };
  return pose.allFinite() &&
         std::all_of(features.begin(), features.end(),
                     [](const Eigen::Vector2d& feature) { return feature.allFinite(); }) &&
         std::all_of(covariance.packed().begin(), covariance.packed().end(), finite_number);
}

}  // namespace slamscope::slam
