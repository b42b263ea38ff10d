// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "slam/jsonl_value.hpp"
#include "slam/snapshot.hpp"

namespace slamscope::slam::json {

/// Numbers of a record whose size is known only when all of the line has been read.
struct Shapes {
  Numbers covariance, diagonal, features, truth_features;
  bool has_time = false, has_pose = false, has_covariance = false, has_diagonal = false;

  void reset() {
    for (Numbers* read : {&covariance, &diagonal, &features, &truth_features}) {
      read->values.clear();
      read->rows.clear();
    }
    has_time = has_pose = has_covariance = has_diagonal = false;
  }
};

/// As many points as `count`, from pairs or a flat list.
[[nodiscard]] std::vector<Eigen::Vector2d> points(const Numbers& read, std::size_t count,
                                                  std::string_view field);
void checkDistinct(std::vector<FeatureId> ids, std::string_view field);
/// From the covariance that was read, or its diagonal; `ids` and `extra` must have been set.
void setCovariance(Snapshot& snapshot, const Shapes& shapes);

}  // namespace slamscope::slam::json
