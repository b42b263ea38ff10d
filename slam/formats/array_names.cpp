// SPDX-License-Identifier: MIT
#include "slam/formats/array_names.hpp"

#include <stdexcept>

namespace slamscope::slam {
namespace {

struct Named {
  std::string name;
  NumberArray array;
};

/// `single`: one number is an array too.
std::optional<Named> firstOf(const std::vector<std::string_view>& names, const ArrayOf& array,
                             bool single) {
  for (const std::string_view name : names) {
    auto found = array(name);
    if (!found || (found->values.size() == 1 && !single)) continue;
    return Named{std::string(name), std::move(*found)};
  }
  return std::nullopt;
}

[[noreturn]] void fail(const Named& named, const std::string& expected) {
  throw std::runtime_error(named.name + ": expected " + expected + ", found " +
                           shapeName(named.array.shape));
}

/// An array of NumPy in Fortran's order has its steps on the last axis, once reversed; MATLAB's
/// custom of steps on the last axis has them on the first then.
std::unique_ptr<Slices> perStep(Named named, std::size_t steps) {
  named.array.shape = squeezed(named.array.shape, steps == 1 ? 1 : 2);
  if (steps == 1) return slicesOf(std::move(named.array), 1, StepAxis::first);
  const auto axis = stepAxis({named.array.shape, StepAxis::first}, steps);
  if (!axis) fail(named, std::to_string(steps) + " rows, one a step");
  return slicesOf(std::move(named.array), steps, *axis);
}

}  // namespace

void addOptionalArrays(RunArrays& arrays, const ArrayOf& array, std::size_t places) {
  using namespace array_names;
  const std::size_t steps = arrays.steps;
  if (auto time = firstOf(kTime, array, steps == 1)) {
    if (time->array.values.size() != steps) fail(*time, std::to_string(steps) + ", one a step");
    arrays.times = std::move(time->array.values);
  }
  if (auto ids = firstOf(kIds, array, steps == 1 || places == 1)) {
    const Shape list = squeezed(ids->array.shape, 1);
    if (list.size() <= 1 && numbersIn(list) == places) {
      arrays.names = std::move(ids->array.values);
    } else {
      arrays.ids = perStep(std::move(*ids), steps);
    }
  }
  if (auto observed = firstOf(kObserved, array, steps == 1)) {
    arrays.observed_is_mask = observed->array.logical;
    arrays.observed = perStep(std::move(*observed), steps);
  }
  if (auto truth = firstOf(kTruth, array, false)) {
    arrays.truth = perStep(std::move(*truth), steps);
  }
}

}  // namespace slamscope::slam
