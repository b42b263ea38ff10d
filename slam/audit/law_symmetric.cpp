// SPDX-License-Identifier: MIT
#include "slam/audit/law_symmetric.hpp"

#include <algorithm>
#include <cmath>

namespace slamscope::slam {

Outcome checkSymmetric(const Snapshot& snapshot, const LogPrecision& precision) {
  if (snapshot.diagonal_only) return Outcome::notCheckable("only diag(P) was logged");
  if (!snapshot.asymmetry) {
    return Outcome::notCheckable("only a triangle of P was written");
  }
  double largest = 0.0;
  for (int i = 0; i < snapshot.covariance.size(); ++i) {
    largest = std::max(largest, std::abs(snapshot.covariance(i, i)));
  }
  if (!(largest > 0.0))
    return *snapshot.asymmetry > 0.0 ? Outcome::of(1.0, 0.0) : Outcome::of(0.0, 0.0);
  double tolerance = 1e-9;
  if (precision.isRounded()) {
    tolerance += 2.5 * (precision.relative() + precision.absolute() / largest);
  }
  Outcome outcome = Outcome::of(*snapshot.asymmetry / largest, tolerance);
  if (outcome.violated()) {
    outcome.amount = "entries of P differ from their mirror images by up to " +
                     std::to_string(outcome.residual * 1e6) + " millionths of the largest variance";
    outcome.show("worst |P - P^T|", *snapshot.asymmetry, 0.0);
    if (outcome.residual < 1e-4) outcome.patterns.emplace_back("asymmetry-of-rounding");
  }
  return outcome;
}

}  // namespace slamscope::slam
