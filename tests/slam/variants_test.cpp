// SPDX-License-Identifier: MIT
// The lawful variants are what they say: correct filters that go other ways.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "slam/faults.hpp"
#include "slam/simulation.hpp"
#include "tests/slam/variants/variants.hpp"

namespace slamscope::slam {
namespace {

struct VariantRun {
  EkfState state;
  Truth truth;
};

VariantRun runVariant(std::unique_ptr<EkfEquations> equations, Sensor sensor, UpdateMode update,
                      const std::shared_ptr<testing::Compass>& compass) {
  SimulationOptions options;
  options.sensor = sensor;
  options.update = update;
  options.loops = 1;
  options.initial_sigma = {0.01, 0.01, 0.005};
  Simulation simulation(options, std::move(equations));
  do {
    compass->heading = simulation.truePose(simulation.filter().time() + simulation.timeStep())[2];
  } while (simulation.step());
  return {simulation.filter().state(), simulation.truth()};
}

VariantRun runVariant(std::string_view variant, Sensor sensor, UpdateMode update) {
  const auto compass = std::make_shared<testing::Compass>();
  return runVariant(testing::makeVariant(variant, sensor, compass), sensor, update, compass);
}

/// Largest largestDifference of means or standard deviations, m or rad.
double largestDifference(const EkfState& a, const EkfState& b) {
  const Eigen::VectorXd sigma = a.P.diagonal().cwiseSqrt() - b.P.diagonal().cwiseSqrt();
  return std::max((a.x - b.x).cwiseAbs().maxCoeff(), sigma.cwiseAbs().maxCoeff());
}

/// Mean squared error of the features normalised by P, two degrees of freedom each.
double featureNees(const VariantRun& outcome) {
  double sum = 0.0;
  const EkfState& state = outcome.state;
  for (std::size_t k = 0; k < state.ids.size(); ++k) {
    const auto row = 3 + 2 * static_cast<Eigen::Index>(k);
    const Eigen::Vector2d error =
        state.x.segment<2>(row) - outcome.truth.features[state.ids[k] - 1];
    const Eigen::Matrix2d P = state.P.block<2, 2>(row, row).selfadjointView<Eigen::Lower>();
    sum += error.dot(P.llt().solve(error));
  }
  return sum / static_cast<double>(2 * state.ids.size());
}

TEST(Variants, OtherFormsOfTheSameUpdateGiveTheSamePosterior) {
  for (const Sensor sensor : {Sensor::range_bearing, Sensor::relative_position}) {
    for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
      const VariantRun plain = runVariant("plain", sensor, update);
      for (const char* form : {"joseph", "square-root", "information", "diffuse"}) {
        EXPECT_LT(largestDifference(runVariant(form, sensor, update).state, plain.state), 1e-6)
            << form;
      }
      // Must-fail twin: not the same update.
      EXPECT_GT(largestDifference(runVariant("compass", sensor, update).state, plain.state), 1e-4);
    }
  }
}

TEST(Variants, OtherLinearisationsStayNearAndDiffer) {
  const VariantRun plain = runVariant("plain", Sensor::range_bearing, UpdateMode::sequential);
  for (const char* other : {"unscented", "iterated", "first-estimates", "frozen"}) {
    const double d = largestDifference(
        runVariant(other, Sensor::range_bearing, UpdateMode::sequential).state, plain.state);
    EXPECT_LT(d, 0.03) << other;
    EXPECT_GT(d, 1e-7) << other;
  }
}

TEST(Variants, EachOneIsConsistent) {
  for (const testing::Variant& variant : testing::kVariants) {
    const VariantRun outcome =
        runVariant(variant.name, Sensor::range_bearing, UpdateMode::sequential);
    EXPECT_EQ(outcome.state.featureCount(), 15) << variant.name;
    EXPECT_LT(featureNees(outcome), 5.0) << variant.name;
  }
  // Must-fail twin: a filter with a fault.
  const auto compass = std::make_shared<testing::Compass>();
  EXPECT_GT(featureNees(runVariant(makeFault("innovation-sign"), Sensor::range_bearing,
                                   UpdateMode::sequential, compass)),
            5.0);
}

TEST(Variants, AnUnknownNameIsRefused) {
  EXPECT_THROW(static_cast<void>(testing::makeVariant("nonesuch", Sensor::range_bearing, nullptr)),
               std::invalid_argument);
}

}  // namespace
}  // namespace slamscope::slam
