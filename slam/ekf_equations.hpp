// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf_rank_update.hpp"
#include "slam/models.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// One reading of one feature, association known.
struct Observation {
  FeatureId id = 0;
  Eigen::Vector2d z = Eigen::Vector2d::Zero();  ///< (range m, bearing rad) or (x m, y m)
  Eigen::Matrix2d R = Eigen::Matrix2d::Zero();  ///< covariance of z
};

/// x̂ and P of section 2.1. Order: x, y, θ, then two rows a feature in the order of `ids`.
struct EkfState {
  std::vector<FeatureId> ids;
  Eigen::VectorXd x;
  /// Only the lower triangle is P; what stands above the diagonal is never read.
  Eigen::MatrixXd P;

  [[nodiscard]] int size() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int featureCount() const { return static_cast<int>(ids.size()); }
  [[nodiscard]] Eigen::Vector3d pose() const { return x.head<3>(); }
  /// Row of the feature's first coordinate; absent where the feature is not in the map.
  [[nodiscard]] std::optional<int> rowOf(FeatureId id) const;
  /// Takes out the feature whose first coordinate is in that row.
  void removeAt(int row);
};

/// The non-zero blocks of H_i (2×N): columns 0–2 and columns `column`, `column` + 1.
struct ObservationJacobian {
  Matrix23d H_v = Matrix23d::Zero();
  Eigen::Matrix2d H_f = Eigen::Matrix2d::Zero();
  int column = 3;

  [[nodiscard]] Eigen::MatrixXd dense(int size) const;
};

/// An observation beside what the filter expected: ν_i and H_i at the current estimate.
struct LinearisedObservation {
  FeatureId id = 0;
  Eigen::Vector2d z = Eigen::Vector2d::Zero();
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  ObservationJacobian H;
  Eigen::Matrix2d R = Eigen::Matrix2d::Zero();
};

/// One Kalman update of m observations at once (m = 1 where updates are sequential).
struct Correction {
  std::vector<LinearisedObservation> observations;
  Eigen::VectorXd innovation;  ///< 2m
  Eigen::MatrixXd S;           ///< 2m×2m, whole
  Eigen::MatrixXd L;           ///< S = L Lᵀ; the lower triangle is meant
  Eigen::MatrixXd PHt;         ///< P Hᵀ, N×2m
  /// P Hᵀ L⁻ᵀ, N×2m: the gain of (11) is W = Y L⁻¹ and W S Wᵀ = Y Yᵀ.
  Eigen::MatrixXd Y;
  /// False where S is not positive definite or not finite: the state was left alone.
  bool applied = false;
};

/// The equations of EKF-SLAM, each behind a virtual function: the seam where a programming fault is
/// planted (`faults.hpp`). EkfSlam calls them in order and holds no equation of its own. Functions
/// are not const so that a fault may remember.
class EkfEquations {
 public:
  explicit EkfEquations(Sensor sensor) : sensor_(sensor) {}
  EkfEquations(const EkfEquations&) = delete;
  EkfEquations& operator=(const EkfEquations&) = delete;
  virtual ~EkfEquations() = default;

  [[nodiscard]] Sensor sensor() const { return sensor_; }

  /// (3) and (4). Returns the Q that was added to P_vv.
  virtual Eigen::Matrix3d predict(EkfState& state, const Motion& motion);
  /// (3): the mean of the pose; by (2) the map stays.
  virtual void predictMean(EkfState& state, const Motion& motion);
  /// F of (4), its upper left 3×3; the rest is the identity.
  [[nodiscard]] virtual Eigen::Matrix3d motionJacobian(const EkfState& state, const Motion& motion);
  /// Q of (4): noise of the motion brought from the body frame to the map, G_u M G_uᵀ.
  [[nodiscard]] virtual Eigen::Matrix3d processNoise(const EkfState& state, const Motion& motion);
  /// P of (4). Touches P_vv and P_vm only: O(N).
  virtual void predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                                 const Eigen::Matrix3d& Q);

  /// What the sensor reports, as the filter takes it in (faults of association live here).
  /// Valid until the next call, and as long as `readings` are.
  [[nodiscard]] virtual std::span<const Observation> perceive(
      const EkfState& state, std::span<const Observation> readings);
  /// R_i of (8), as the filter believes it.
  [[nodiscard]] virtual Eigen::Matrix2d observationNoise(const Eigen::Matrix2d& R);
  /// (6), (7): z_i − h_i(x̂).
  [[nodiscard]] virtual Eigen::Vector2d innovation(const EkfState& state, int row,
                                                   const Eigen::Vector2d& z);
  /// H_i of (8).
  [[nodiscard]] virtual ObservationJacobian observationJacobian(const EkfState& state, int row);

  /// ν_i, H_i and R_i of one observation at the current estimate. The feature must be in the map.
  [[nodiscard]] LinearisedObservation linearise(const EkfState& state,
                                                const Observation& observation);
  /// (8) for one observation.
  [[nodiscard]] Eigen::Matrix2d innovationCovariance(
      const EkfState& state, const LinearisedObservation& observation) const;

  /// (7)–(11) for all the given observations of known features at once.
  virtual Correction update(EkfState& state, std::span<const Observation> observations);
  /// Takes back the memory of a correction, so that the next one of as many observations needs
  /// none.
  void reuse(Correction&& correction);
  /// Threads that (10) may use, 1 or 2.
  void setThreads(int threads) { rank_update_.setThreads(threads); }
  /// (9)
  virtual void updateMean(EkfState& state, const Correction& correction);
  /// (10), as a rank update of the lower triangle.
  virtual void updateCovariance(EkfState& state, const Correction& correction);

  /// Appends a feature: mean by the inverse observation model, covariance by its Jacobians.
  virtual void initialise(EkfState& state, const Observation& observation);
  /// The rows of P of the feature that was appended last: P_fv = G_v P_vv, P_fm = G_v P_vm,
  /// P_ff = G_v P_vv G_vᵀ + G_z R G_zᵀ.
  virtual void initialiseCovariance(EkfState& state, const Matrix23d& G_v,
                                    const Eigen::Matrix2d& G_z, const Eigen::Matrix2d& R);

  /// Worst |P − Pᵀ| where a (faulty) filter keeps both triangles; absent where it keeps one.
  [[nodiscard]] virtual std::optional<double> asymmetry(const EkfState& state) const;

 protected:
  /// (8) and (11) for all observations at once; `applied` tells whether S could be factorised.
  [[nodiscard]] Correction correct(const EkfState& state,
                                   std::vector<LinearisedObservation> observations) const;

 private:
  [[nodiscard]] Correction spare(std::size_t observations);

  Sensor sensor_;
  RankUpdate rank_update_;
  Eigen::VectorXd whitened_;        ///< L⁻¹ ν of (9), and memory to spare
  std::vector<Correction> spares_;  ///< by number of observations
};

}  // namespace slamscope::slam
