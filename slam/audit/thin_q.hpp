// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/QR>

namespace slamscope::slam {

/// First `columns` columns of the Q of a pivoted QR: an orthonormal basis, rows(A) × columns, of
/// the span of that many pivots. (One reflection after the other: Eigen's product of a Householder
/// sequence takes seconds to compile.)
Eigen::MatrixXd thinQ(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>& qr, Eigen::Index columns);

}  // namespace slamscope::slam
