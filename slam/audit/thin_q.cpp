// SPDX-License-Identifier: MIT
#include "slam/audit/thin_q.hpp"

namespace slamscope::slam {

Eigen::MatrixXd thinQ(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index columns) {
  return qr.householderQ() * Eigen::MatrixXd::Identity(qr.rows(), columns);
}

}  // namespace slamscope::slam
