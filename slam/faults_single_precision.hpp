// SPDX-License-Identifier: MIT
#pragma once

#include "slam/ekf_equations.hpp"

namespace slamscope::slam {

/// A filter that keeps the whole of P, both triangles, in single precision, updates it as
/// (I − K H) P and never makes it symmetric again. The values stand in `EkfState::P` and are
/// floats; the snapshot has its lower triangle and, as `asymmetry`, how far the upper one is off.
class SinglePrecision final : public EkfEquations {
 public:
  using EkfEquations::EkfEquations;

  void predictCovariance(EkfState& state, const Eigen::Matrix3d& F,
                         const Eigen::Matrix3d& Q) override;
  void updateCovariance(EkfState& state, const Correction& correction) override;
  void initialiseCovariance(EkfState& state, const Matrix23d& G_v, const Eigen::Matrix2d& G_z,
                            const Eigen::Matrix2d& R) override;
  [[nodiscard]] std::optional<double> asymmetry(const EkfState& state) const override;
};

}  // namespace slamscope::slam
