// SPDX-License-Identifier: MIT
#include "slam/jsonl_shapes.hpp"

#include <algorithm>

namespace slamscope::slam::json {
namespace {

std::string plural(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

bool isRagged(const Numbers& read, std::size_t n) {
  if (read.rows.size() != n) return false;
  for (std::size_t row = 0; row < n; ++row) {
    if (read.rows[row] != row + 1) return false;
  }
  return true;
}

void setDiagonal(Snapshot& snapshot, const Shapes& shapes, std::size_t n) {
  if (!shapes.has_diagonal) fail("covariance", "covariance or covariance_diagonal", "neither");
  if (shapes.diagonal.values.size() != n || !shapes.diagonal.isList()) {
    fail("covariance_diagonal", plural(n, "number"), shapes.diagonal.describe());
  }
  snapshot.diagonal_only = true;
  snapshot.covariance = PackedCovariance(static_cast<int>(n));
  for (int k = 0; k < snapshot.covariance.size(); ++k) {
    snapshot.covariance(k, k) = shapes.diagonal.values[static_cast<std::size_t>(k)];
  }
}

}  // namespace

std::vector<Eigen::Vector2d> points(const Numbers& read, std::size_t count,
                                    std::string_view field) {
  if (read.values.size() != 2 * count || !(read.rowsOf(2) || read.isList())) {
    fail(field, plural(count, "pair") + " [x, y], as many as ids", read.describe());
  }
  std::vector<Eigen::Vector2d> result(count);
  for (std::size_t k = 0; k < count; ++k) {
    result[k] = {read.values[2 * k], read.values[2 * k + 1]};
  }
  return result;
}

void checkDistinct(std::vector<FeatureId> ids, std::string_view field) {
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) fail(field, "each id once", std::to_string(*twice) + " twice");
}

void setCovariance(Snapshot& snapshot, const Shapes& shapes) {
  const std::size_t n = 3 + 2 * snapshot.ids.size() + snapshot.extra.size();
  const int size = static_cast<int>(n);
  const Numbers& read = shapes.covariance;
  if (!shapes.has_covariance) return setDiagonal(snapshot, shapes, n);
  const std::size_t packed = n * (n + 1) / 2;
  if (read.values.size() == packed && (read.rows.empty() || isRagged(read, n))) {
    snapshot.covariance = PackedCovariance(size, std::vector<double>(read.values));
  } else if (read.values.size() == n * n && (read.rows.empty() || read.rowsOf(n))) {
    double asymmetry = 0.0;
    snapshot.covariance = PackedCovariance::fromFull(size, read.values, asymmetry);
    snapshot.asymmetry = std::max(asymmetry, snapshot.asymmetry.value_or(0.0));
  } else {
    const std::string side = std::to_string(n);
    fail("covariance",
         side + "×" + side + " as rows or " + std::to_string(packed) + " numbers packed (" +
             plural(snapshot.ids.size(), "feature") + ")",
         read.describe());
  }
}

}  // namespace slamscope::slam::json
