// SPDX-License-Identifier: MIT
#include "slam/audit/thin_q.hpp"

#include <algorithm>

namespace slamscope::slam {

Eigen::MatrixXd thinQ(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index columns) {
  const Eigen::Index rows = qr.rows();
  Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(rows, columns);
  Eigen::VectorXd workspace(columns);
  for (Eigen::Index k = std::min(columns, qr.hCoeffs().size()); k-- > 0;) {
    Q.bottomRows(rows - k).applyHouseholderOnTheLeft(qr.matrixQR().col(k).tail(rows - k - 1),
                                                     qr.hCoeffs()[k], workspace.data());
  }
  return Q;
}

}  // namespace slamscope::slam
