// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace slamscope::slam {

/// P ← P − Y Yᵀ in the lower triangle of P (N×N); what stands above the diagonal is left alone. Y
/// is N×m with small m: the covariance update of a batch of observations, equation (10), and nearly
/// all the time of an EKF step. Compiled for several instruction sets, the best one taken at run
/// time.
void subtractOuterProduct(Eigen::MatrixXd& P, const Eigen::MatrixXd& Y);

}  // namespace slamscope::slam
