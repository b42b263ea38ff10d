// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace slamscope::slam {

using FeatureId = std::uint64_t;

/// A time or a duration as a number of seconds.
[[nodiscard]] inline double seconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double>(time).count();
}

/// What just happened to the posterior. `step`: everything of one time step at once.
enum class Event { initial, predict, update, initialise, remove, step };

/// Lower triangle of a symmetric n×n matrix, packed row by row: (0,0) (1,0) (1,1) (2,0) …
/// Symmetric by construction.
class PackedCovariance {
 public:
  PackedCovariance() = default;
  explicit PackedCovariance(int size);
  /// Throws std::invalid_argument unless packed.size() == size (size + 1) / 2.
  PackedCovariance(int size, std::vector<double> packed);
  /// Reads the lower triangle only.
  [[nodiscard]] static PackedCovariance fromLower(const Eigen::Ref<const Eigen::MatrixXd>& P);
  /// The lower triangle of size×size numbers, row by row; `asymmetry` becomes the worst |P − Pᵀ|.
  /// A number that is NaN on one side only is asymmetric beyond measure.
  [[nodiscard]] static PackedCovariance fromFull(int size, std::span<const double> full,
                                                 double& asymmetry);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] double operator()(int row, int col) const { return packed_[index(row, col)]; }
  double& operator()(int row, int col) { return packed_[index(row, col)]; }
  /// 2×2 block with its upper left corner at (row, col).
  [[nodiscard]] Eigen::Matrix2d block2(int row, int col) const;
  [[nodiscard]] Eigen::MatrixXd dense() const;
  [[nodiscard]] std::span<const double> packed() const { return packed_; }

 private:
  [[nodiscard]] static std::size_t index(int row, int col) {
    const auto [low, high] = row < col ? std::pair{row, col} : std::pair{col, row};
    return static_cast<std::size_t>(high) * (static_cast<std::size_t>(high) + 1) / 2 +
           static_cast<std::size_t>(low);
  }

  int size_ = 0;
  std::vector<double> packed_;
};

/// One observation as the filter used it (level L3 of the audit).
struct ObservationRecord {
  FeatureId id = 0;
  Eigen::Vector2d z = Eigen::Vector2d::Zero();
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d R = Eigen::Matrix2d::Zero();
  Eigen::MatrixXd H;  ///< 2×N, empty where not recorded
};

/// True values in the frame of the map (origin: the robot's true pose when SLAM started).
struct Truth {
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();  ///< x, y (m), θ (rad)
  std::vector<FeatureId> ids;
  std::vector<Eigen::Vector2d> features;  ///< m
};

/// One posterior of an EKF-SLAM filter. State order: x, y, θ, then features in the order of `ids`,
/// then `extra`. An immutable value once published, shared by SnapshotPtr.
struct Snapshot {
  std::chrono::nanoseconds time{};
  std::uint64_t sequence = 0;
  Event event = Event::step;
  Eigen::Vector3d pose = Eigen::Vector3d::Zero();  ///< x, y (m), θ (rad)
  std::vector<FeatureId> ids;
  std::vector<Eigen::Vector2d> features;  ///< m, frame of the map
  /// Features of the map that have not been seen often enough to be believed in, of `ids`. Spurious
  /// ones never get beyond.
  std::vector<FeatureId> tentative;
  std::vector<std::string> extra;  ///< names of states appended after the features
  PackedCovariance covariance;     ///< m², m·rad, rad²; size 3 + 2n + extra
  bool diagonal_only = false;      ///< off-diagonal entries were not logged (level L0)
  /// Worst |P − Pᵀ| of the full matrix that was read; absent where only a triangle was written.
  std::optional<double> asymmetry;
  std::vector<FeatureId> observed;  ///< ids observed in this event
  bool observed_given = false;      ///< tells "none observed" from "not recorded"
  std::vector<ObservationRecord> observations;
  std::optional<Eigen::VectorXd> control;
  std::optional<Eigen::Matrix3d> Q;
  std::optional<Truth> truth;

  [[nodiscard]] int featureCount() const { return static_cast<int>(ids.size()); }
  /// Row of the first coordinate of the feature at `index` in state order.
  [[nodiscard]] static int row(int index) { return 3 + 2 * index; }
  [[nodiscard]] std::optional<int> indexOf(FeatureId id) const;
  /// P_vv, of x, y (m²), θ (rad²).
  [[nodiscard]] Eigen::Matrix3d poseCovariance() const;
  [[nodiscard]] bool isTentative(FeatureId id) const {
    return std::find(tentative.begin(), tentative.end(), id) != tentative.end();
  }
  /// Every mean and every logged covariance entry is a finite number.
  [[nodiscard]] bool finite() const;
};

using SnapshotPtr = std::shared_ptr<const Snapshot>;

enum class Sensor { unknown, range_bearing, relative_position };

/// What a run says of itself before its first record.
struct RunHeader {
  int version = 1;
  Sensor sensor = Sensor::unknown;
  std::string robot;
  std::optional<Eigen::Matrix2d> R;  ///< constant observation noise, where known
  std::optional<Eigen::Matrix3d> Q;  ///< constant process noise, where known
  /// False where only covariances were logged (level LC): poses and features are then NaN.
  bool means_known = true;
};

}  // namespace slamscope::slam
