// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/formats/array_run.hpp"

namespace slamscope::slam {

/// Names under which people save the arrays of a run; the first that is there is taken.
namespace array_names {
inline const std::vector<std::string_view> kX{"x", "X", "mu", "xs", "x_est", "xEst", "arr_0"};
inline const std::vector<std::string_view> kP{"P",     "Sigma", "sigma", "Ps",
                                              "P_est", "PEst",  "cov",   "arr_1"};
inline const std::vector<std::string_view> kTime{"t", "time_s", "time", "times"};
inline const std::vector<std::string_view> kIds{"ids"};
inline const std::vector<std::string_view> kObserved{"observed"};
inline const std::vector<std::string_view> kEvent{"event", "events"};
inline const std::vector<std::string_view> kTruth{"true", "truth", "xtrue", "x_true", "xTrue"};
}  // namespace array_names

/// The numbers of that name; nothing where there are none.
using ArrayOf = std::function<std::optional<NumberArray>(std::string_view)>;

/// How many features a state of so many numbers has room for.
[[nodiscard]] inline std::size_t featurePlaces(std::size_t numbers) {
  return numbers < 3 ? 0 : (numbers - 3) / 2;
}

/// Adds times, ids, observed and true poses, as far as they are there, to arrays of known `steps`;
/// `places` is the largest number of features. A single number of one of those names is taken for
/// what a saved work space holds besides and passed over; another shape that does not fit throws
/// std::runtime_error "name: expected …, found …".
void addOptionalArrays(RunArrays& arrays, const ArrayOf& array, std::size_t places);

}  // namespace slamscope::slam
