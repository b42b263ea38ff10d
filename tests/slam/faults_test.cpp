// SPDX-License-Identifier: MIT
#include "slam/faults.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>
#include <string>

#include "slam/simulation.hpp"

namespace slamscope::slam {
namespace {

using std::chrono::nanoseconds;

/// Where a run ended: did the state stay finite, and what was it?
struct Outcome {
  EkfState state;
  bool finite = true;
  double worst_asymmetry = -1.0;  ///< of snapshots that have one
};

Outcome run(const std::string& fault, UpdateMode update = UpdateMode::batch,
            std::uint64_t seed = 1) {
  SimulationOptions options;
  options.fault = fault;
  options.loops = 2;
  options.update = update;
  options.seed = seed;
  options.initial_sigma = {0.01, 0.01, 0.005};
  Simulation simulation(options);
  Outcome outcome;
  const Subscription subscription =
      simulation.filter().observe({Event::step}, [&](const SnapshotPtr& snapshot) {
        outcome.finite = outcome.finite && snapshot->finite();
        if (snapshot->asymmetry) {
          outcome.worst_asymmetry = std::max(outcome.worst_asymmetry, *snapshot->asymmetry);
        }
      });
  while (simulation.step()) {
  }
  outcome.state = simulation.filter().state();
  return outcome;
}

Eigen::MatrixXd whole(const EkfState& state) {
  return state.P.selfadjointView<Eigen::Lower>();
}

/// Largest difference of mean or covariance.
double difference(const EkfState& a, const EkfState& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  return std::max((a.x - b.x).cwiseAbs().maxCoeff(), (whole(a) - whole(b)).cwiseAbs().maxCoeff());
}

bool positive(const EkfState& state) {
  return Eigen::LLT<Eigen::MatrixXd>(whole(state)).info() == Eigen::Success;
}

class EachFault : public ::testing::TestWithParam<std::string> {};

TEST_P(EachFault, ChangesTheRun) {
  for (const UpdateMode update : {UpdateMode::batch, UpdateMode::sequential}) {
    EXPECT_GT(difference(run(GetParam(), update).state, run("none", update).state), 1e-8);
  }
}

TEST_P(EachFault, IsTheSameRunForTheSameSeed) {
  EXPECT_EQ(difference(run(GetParam()).state, run(GetParam()).state), 0.0);
  EXPECT_GT(difference(run(GetParam()).state, run(GetParam(), UpdateMode::batch, 2).state), 0.0);
}

TEST_P(EachFault, LeavesTheFilterRunningToTheEnd) {
  const Outcome outcome = run(GetParam());
  EXPECT_EQ(outcome.state.featureCount(), 15);
  EXPECT_TRUE(outcome.finite);
}

std::vector<std::string> faultsButNone() {
  std::vector<std::string> names;
  for (const FaultDescription& fault : faultNames().subspan(1)) names.emplace_back(fault.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EachFault, ::testing::ValuesIn(faultsButNone()),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(Faults, AreTheTwentyFourOfTheCatalogue) {
  const std::set<std::string> expected = {
      "paper",
      "no-cross-prediction",
      "motion-jacobian-late",
      "motion-jacobian-swapped",
      "motion-jacobian-transposed",
      "bearing-jacobian-1q",
      "bearing-jacobian-sign",
      "stale-linearisation",
      "wrong-block",
      "initialise-uncorrelated",
      "initialise-identity",
      "cross-not-updated",
      "diagonal-only",
      "noise-on-map",
      "single-precision",
      "observed-twice",
      "innovation-unwrapped",
      "innovation-sign",
      "wrong-association",
      "moved-feature",
      "noise-sigma",
      "noise-degrees",
      "noise-9x",
      "noise-unrotated",
  };
  const std::vector<std::string> names = faultsButNone();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), expected);
  EXPECT_EQ(faultNames().front().name, "none");
  for (const FaultDescription& fault : faultNames().subspan(1)) {
    EXPECT_NE(fault.kind, FaultKind::none) << fault.name;
    EXPECT_TRUE(fault.level == 1 || fault.level == 2) << fault.name;
    EXPECT_FALSE(fault.description.empty()) << fault.name;
  }
}

TEST(Faults, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    static_cast<void>(makeFault("papre"));
    FAIL();
  } catch (const std::invalid_argument& refused) {
    EXPECT_NE(std::string(refused.what()).find("papre"), std::string::npos);
    EXPECT_NE(std::string(refused.what()).find("noise-unrotated"), std::string::npos);
  }
}

TEST(Faults, BugsOfBearingsNeedASensorOfBearings) {
  for (const char* name :
       {"bearing-jacobian-1q", "bearing-jacobian-sign", "innovation-unwrapped", "noise-degrees"}) {
    EXPECT_THROW(static_cast<void>(makeFault(name, {Sensor::relative_position, {}})),
                 std::invalid_argument)
        << name;
  }
  EXPECT_NO_THROW(static_cast<void>(makeFault("wrong-block", {Sensor::relative_position, {}})));
}

TEST(Faults, SinglePrecisionShowsInTheAsymmetryOfSnapshots) {
  EXPECT_GT(run("single-precision").worst_asymmetry, 1e-11);
  EXPECT_EQ(run("none").worst_asymmetry, -1.0);  // a correct filter keeps one triangle
}

TEST(Faults, TheNoiseOfACorrectRunKeepsThePosteriorPositive) {
  EXPECT_TRUE(positive(run("none").state));
  EXPECT_FALSE(positive(run("cross-not-updated").state));  // must-fail twin
}

}  // namespace
}  // namespace slamscope::slam
