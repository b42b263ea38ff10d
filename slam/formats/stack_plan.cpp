// SPDX-License-Identifier: MIT
#include "slam/formats/stack_plan.hpp"

#include <algorithm>
#include <stdexcept>

namespace slamscope::slam {
namespace {

[[noreturn]] void fail(const std::string& field, const std::string& expected, const Shape& found) {
  throw std::runtime_error(field + ": expected " + expected + ", found " + shapeName(found));
}

bool isStateSize(std::size_t size) {
  return size >= 3 && size % 2 == 1;
}

/// One of two axes that could count the steps; where both could, the usual one.
std::optional<StepAxis> choose(bool first, bool last, StepAxis usual) {
  if (first && last) return usual;
  if (first) return StepAxis::first;
  if (last) return StepAxis::last;
  return std::nullopt;
}

StackPlan fromCovariances(const Stacked& P) {
  const Shape& s = P.shape;
  const auto axis = choose(s[1] == s[2], s[0] == s[1], P.usual);
  if (!axis) fail("P", "steps × N × N", s);
  StackPlan plan;
  plan.P = *axis;
  plan.steps = *axis == StepAxis::first ? s[0] : s[2];
  plan.size = s[1];
  return plan;
}

/// P has the axes of x: variances, a step each.
StackPlan fromVariances(const Stacked& P) {
  const Shape& s = P.shape;
  const auto axis = choose(isStateSize(s[1]), isStateSize(s[0]), P.usual);
  if (!axis) fail("P", "N × N a step, or N variances, with N = 3 + 2 a feature", s);
  StackPlan plan;
  plan.P = *axis;
  plan.steps = *axis == StepAxis::first ? s[0] : s[1];
  plan.size = *axis == StepAxis::first ? s[1] : s[0];
  plan.diagonal = true;
  return plan;
}

StackPlan oneStep(std::size_t size, bool diagonal) {
  return {.steps = 1, .size = size, .diagonal = diagonal};
}

StackPlan fromP(const std::optional<Stacked>& x, const Stacked& P) {
  const Shape& s = P.shape;
  if (s.size() == 3) return fromCovariances(P);
  if (s.size() == 1 && x && numbersIn(x->shape) == s[0]) return oneStep(s[0], true);
  if (s.size() != 2) fail("P", "steps × N × N", s);
  const bool square = s[0] == s[1];
  if (square && (!x || numbersIn(x->shape) == s[0])) return oneStep(s[0], false);
  if (x && numbersIn(x->shape) == s[0] * s[1]) return fromVariances(P);
  fail("P", x ? "steps × N × N, or as many variances as x has numbers" : "steps × N × N", s);
}

}  // namespace

Shape squeezed(Shape shape, std::size_t axes) {
  for (auto at = shape.begin(); at != shape.end() && shape.size() > axes;) {
    at = *at == 1 ? shape.erase(at) : at + 1;
  }
  return shape;
}

std::optional<StepAxis> stepAxis(const Stacked& array, std::size_t steps) {
  const Shape& s = array.shape;
  if (s.size() == 1 && s[0] == steps) return StepAxis::first;
  if (s.size() != 2) return std::nullopt;
  return choose(s[0] == steps, s[1] == steps, array.usual);
}

StackPlan planStack(const std::optional<Stacked>& x, const Stacked& P) {
  StackPlan plan = fromP(x, P);
  if (!isStateSize(plan.size)) {
    throw std::runtime_error(
        "P: expected N × N a step with N = 3 + 2 a feature (x, y, heading, then x, y of each), "
        "found N = " +
        std::to_string(plan.size));
  }
  if (!x) return plan;
  const Shape& s = x->shape;
  const auto expected = std::to_string(plan.steps) + "×" + std::to_string(plan.size) +
                        ", as P is " + shapeName(P.shape);
  if (numbersIn(s) != plan.steps * plan.size) fail("x", expected, s);
  if (plan.steps == 1) return plan;
  if (s.size() != 2) fail("x", expected, s);
  const auto axis = choose(s[0] == plan.steps && s[1] == plan.size,
                           s[1] == plan.steps && s[0] == plan.size, x->usual);
  if (!axis) fail("x", expected, s);
  plan.x = *axis;
  return plan;
}

}  // namespace slamscope::slam
