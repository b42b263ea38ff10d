// SPDX-License-Identifier: MIT
#include "slam/formats/stack_plan.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace slamscope::slam {
namespace {

constexpr auto kFirst = StepAxis::first, kLast = StepAxis::last;

StackPlan plan(const Shape& x, const Shape& P, StepAxis usual = kFirst) {
  return planStack(Stacked{x, usual}, {P, usual});
}

std::string refusalOf(const std::optional<Stacked>& x, const Shape& P) {
  try {
    static_cast<void>(planStack(x, {P}));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(StackPlan, FindsTheAxisOfTheSteps) {
  const StackPlan first = plan({100, 7}, {100, 7, 7});
  EXPECT_EQ(first.steps, 100U);
  EXPECT_EQ(first.size, 7U);
  EXPECT_EQ(first.x, kFirst);
  EXPECT_EQ(first.P, kFirst);
  const StackPlan last = plan({7, 100}, {7, 7, 100});
  EXPECT_EQ(last.steps, 100U);
  EXPECT_EQ(last.x, kLast);
  EXPECT_EQ(last.P, kLast);
  const StackPlan mixed = plan({7, 100}, {100, 7, 7});
  EXPECT_EQ(mixed.x, kLast);
  EXPECT_EQ(mixed.P, kFirst);
}

TEST(StackPlan, TakesTheUsualAxisWhereTheShapeLeavesBothOpen) {
  EXPECT_EQ(plan({7, 7}, {7, 7, 7}).P, kFirst);
  EXPECT_EQ(plan({7, 7}, {7, 7, 7}, kLast).P, kLast);
  EXPECT_EQ(plan({7, 7}, {7, 7, 7}, kLast).x, kLast);
}

TEST(StackPlan, VariancesInTheShapeOfXAreTheDiagonal) {
  const StackPlan steps_first = plan({100, 7}, {100, 7});
  EXPECT_TRUE(steps_first.diagonal);
  EXPECT_EQ(steps_first.steps, 100U);
  const StackPlan steps_last = plan({7, 100}, {7, 100});
  EXPECT_EQ(steps_last.steps, 100U);
  EXPECT_EQ(steps_last.P, kLast);
}

TEST(StackPlan, OneStepNeedsNoAxisOfItsOwn) {
  EXPECT_EQ(plan({7}, {7, 7}).steps, 1U);
  EXPECT_EQ(planStack(std::nullopt, {{7, 7}, kFirst}).steps, 1U);
  EXPECT_TRUE(plan({7}, {7}).diagonal);
}

TEST(StackPlan, CovariancesAloneNeedNoX) {
  EXPECT_EQ(planStack(std::nullopt, {{100, 7, 7}, kFirst}).steps, 100U);
}

TEST(StackPlan, ShapesThatDoNotFitAreNamed) {
  EXPECT_EQ(refusalOf(Stacked{{100, 7}}, {100, 7, 5}), "P: expected steps × N × N, found 100×7×5");
  EXPECT_EQ(refusalOf(Stacked{{99, 7}}, {100, 7, 7}),
            "x: expected 100×7, as P is 100×7×7, found 99×7");
  EXPECT_EQ(refusalOf(Stacked{{100, 9}}, {100, 7, 7}),
            "x: expected 100×7, as P is 100×7×7, found 100×9");
  EXPECT_EQ(refusalOf(Stacked{{700}}, {100, 7, 7}),
            "x: expected 100×7, as P is 100×7×7, found 700");
  EXPECT_EQ(refusalOf(Stacked{{100, 6}}, {100, 6, 6}),
            "P: expected N × N a step with N = 3 + 2 a feature (x, y, heading, then x, y of each), "
            "found N = 6");
  EXPECT_EQ(refusalOf(std::nullopt, {100, 7}), "P: expected steps × N × N, found 100×7");
}

}  // namespace
}  // namespace slamscope::slam
