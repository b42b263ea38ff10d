// SPDX-License-Identifier: MIT
// Each fault does what its name claims, and nothing else: its equation beside the lawful one.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "slam/faults.hpp"
#include "slam/simulation.hpp"

namespace slamscope::slam {
namespace {

const Eigen::Matrix2d kNoise = Eigen::Vector2d(0.0036, 0.0016).asDiagonal();

/// A posterior from the middle of a healthy run, the whole of P in both triangles.
EkfState healthyState() {
  SimulationOptions options;
  options.loops = 1;
  options.initial_sigma = {0.02, 0.02, 0.01};
  Simulation simulation(options);
  while (simulation.progress() < 0.6) simulation.step();
  EkfState state = simulation.filter().state();
  state.P = Eigen::MatrixXd(state.P.selfadjointView<Eigen::Lower>());
  return state;
}

Motion someMotion() {
  return Motion::fromVelocity(0.25, 1.2, 0.1, Eigen::Vector2d(9e-4, 3.6e-3).asDiagonal());
}

Observation readingOf(const EkfState& state, int index, const Eigen::Vector2d& error) {
  const Eigen::Vector2d feature = state.x.segment<2>(3 + 2 * index);
  return {state.ids[static_cast<std::size_t>(index)],
          observeFeature(Sensor::range_bearing, state.pose(), feature) + error, kNoise};
}

Eigen::MatrixXd symmetric(const EkfState& state) {
  return state.P.selfadjointView<Eigen::Lower>();
}

struct Beside {
  EkfState before, lawful, faulty;
};

enum class Act { predict, update, initialise };

Beside act(const std::string& fault, Act what) {
  Beside result{healthyState(), {}, {}};
  const auto run = [&](const std::string& name) {
    const auto equations = makeFault(name, {Sensor::range_bearing, {2}});
    EkfState state = result.before;
    if (what == Act::predict) equations->predict(state, someMotion());
    if (what == Act::update) {
      const std::vector<Observation> readings{readingOf(state, 4, {0.05, -0.03}),
                                              readingOf(state, 7, {-0.02, 0.04})};
      equations->update(state, readings);
    }
    if (what == Act::initialise) equations->initialise(state, {99, {1.3, 0.4}, kNoise});
    return state;
  };
  result.lawful = run("none");
  result.faulty = run(fault);
  return result;
}

double largest(const Eigen::MatrixXd& m) {
  return m.cwiseAbs().maxCoeff();
}

Eigen::Matrix3d motionJacobianOf(const std::string& fault, const EkfState& state) {
  return makeFault(fault)->motionJacobian(state, someMotion());
}

TEST(FaultyPrediction, NoCrossPredictionLeavesTheCrossCovarianceAsItWas) {
  const Beside a = act("no-cross-prediction", Act::predict);
  const auto rest = a.before.size() - 3;
  EXPECT_EQ(largest(symmetric(a.faulty).topRightCorner(3, rest) -
                    symmetric(a.before).topRightCorner(3, rest)),
            0.0);
  EXPECT_GT(largest(symmetric(a.lawful).topRightCorner(3, rest) -
                    symmetric(a.before).topRightCorner(3, rest)),
            1e-8);
  EXPECT_EQ(
      largest(symmetric(a.faulty).topLeftCorner(3, 3) - symmetric(a.lawful).topLeftCorner(3, 3)),
      0.0);
}

TEST(FaultyPrediction, EachJacobianIsTheLawfulOneWithItsBug) {
  const EkfState state = healthyState();
  const Eigen::Matrix3d F = motionJacobianOf("none", state);
  EXPECT_EQ(largest(motionJacobianOf("motion-jacobian-transposed", state) - F.transpose()), 0.0);

  const Eigen::Matrix3d swapped = motionJacobianOf("motion-jacobian-swapped", state);
  EXPECT_EQ(swapped(0, 2), -F(1, 2));
  EXPECT_EQ(swapped(1, 2), -F(0, 2));

  EkfState turned = state;
  turned.x[2] += someMotion().increment[2];
  const Eigen::Matrix3d late = motionJacobianOf("motion-jacobian-late", state);
  EXPECT_LT(largest(late - motionJacobianOf("none", turned)), 1e-15);
  EXPECT_GT(largest(late - F), 1e-4);
}

TEST(FaultyPrediction, NoiseOnMapGrowsTheFeaturesDiagonal) {
  const Beside a = act("noise-on-map", Act::predict);
  Eigen::MatrixXd growth = symmetric(a.faulty) - symmetric(a.lawful);
  EXPECT_GT(growth.diagonal().tail(growth.rows() - 3).minCoeff(), 0.0);
  growth.diagonal().tail(growth.rows() - 3).setZero();
  EXPECT_EQ(largest(growth), 0.0);
}

TEST(FaultyPrediction, UnrotatedNoiseIsThatOfTheBodyWhileTheRotatedOneIsDeclared) {
  EkfState faulty = healthyState();
  EkfState lawful = faulty;
  const Eigen::Matrix3d declared = makeFault("noise-unrotated")->predict(faulty, someMotion());
  const Eigen::Matrix3d Q = makeFault("none")->predict(lawful, someMotion());
  EXPECT_EQ(largest(declared - Q), 0.0);
  EXPECT_LT(
      largest((symmetric(faulty) - symmetric(lawful)).topLeftCorner(3, 3) - (someMotion().M - Q)),
      1e-15);
  EXPECT_GT(largest(someMotion().M - Q), 1e-7);
}

TEST(FaultyObservation, JacobiansOfBearingsDifferInTheHeadingOnly) {
  const EkfState state = healthyState();
  const int row = 3;
  const ObservationJacobian lawful = makeFault("none")->observationJacobian(state, row);
  const double q = (state.x.segment<2>(row) - state.x.head<2>()).squaredNorm();
  for (const auto& [name, entry] :
       {std::pair{"bearing-jacobian-1q", -1.0 / q}, std::pair{"bearing-jacobian-sign", 1.0}}) {
    ObservationJacobian H = makeFault(name)->observationJacobian(state, row);
    EXPECT_DOUBLE_EQ(H.H_v(1, 2), entry) << name;
    H.H_v(1, 2) = lawful.H_v(1, 2);
    EXPECT_EQ(largest(H.dense(state.size()) - lawful.dense(state.size())), 0.0) << name;
  }
}

TEST(FaultyObservation, StaleLinearisationIsThatOfTheStateBeforeThePrediction) {
  const auto stale = makeFault("stale-linearisation");
  const auto lawful = makeFault("none");
  EkfState state = healthyState();
  const EkfState old = state;
  stale->predict(state, someMotion());
  const int size = state.size();
  const Eigen::MatrixXd H = stale->observationJacobian(state, 5).dense(size);
  EXPECT_EQ(largest(H - lawful->observationJacobian(old, 5).dense(size)), 0.0);
  EXPECT_GT(largest(H - lawful->observationJacobian(state, 5).dense(size)), 1e-3);
}

TEST(FaultyObservation, WrongBlockIsTheNextOneAndTheLastOneWraps) {
  const EkfState state = healthyState();
  const auto column = [&](int row) {
    return makeFault("wrong-block")->observationJacobian(state, row).column;
  };
  EXPECT_EQ(column(3), 5);
  EXPECT_EQ(column(state.size() - 2), state.size() - 4);
  EXPECT_EQ(makeFault("none")->observationJacobian(state, 3).column, 3);
}

TEST(FaultyInitialisation, UncorrelatedFeatureKeepsItsOwnCovariance) {
  const Beside a = act("initialise-uncorrelated", Act::initialise);
  const auto old = a.before.size();
  EXPECT_EQ(largest(symmetric(a.faulty).bottomLeftCorner(2, old)), 0.0);
  EXPECT_GT(largest(symmetric(a.lawful).bottomLeftCorner(2, old)), 1e-5);
  EXPECT_EQ(largest((symmetric(a.faulty) - symmetric(a.lawful)).bottomRightCorner(2, 2)), 0.0);
}

TEST(FaultyInitialisation, IdentityFeatureHasTheIdentityAndNothingElse) {
  const Beside a = act("initialise-identity", Act::initialise);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(2, a.faulty.size());
  expected.rightCols<2>().setIdentity();
  EXPECT_EQ(largest(symmetric(a.faulty).bottomRows(2) - expected), 0.0);
  EXPECT_GT(largest(symmetric(a.lawful).bottomRows(2) - expected), 0.5);
}

TEST(FaultyUpdate, ThePapersFaultTouchesOneBlock) {
  SimulationOptions options;
  options.loops = 1;
  options.fault = "paper";
  options.fault_features = {2};
  Simulation faulty(options);
  options.fault = "none";
  Simulation lawful(options);
  while (faulty.progress() < 0.02) {  // the first updates, of a robot at rest
    faulty.step();
    lawful.step();
  }
  const int row = faulty.filter().state().rowOf(2).value();
  Eigen::MatrixXd change = symmetric(faulty.filter().state()) - symmetric(lawful.filter().state());
  EXPECT_GT(change.block(row, row, 2, 2).diagonal().minCoeff(), 0.0);
  Eigen::MatrixXd one(Eigen::MatrixXd::Zero(1, 1));
  one(0, 0) = largest(change.block(row, row, 2, 2));
  change.block(row, row, 2, 2).setZero();
  EXPECT_GT(one(0, 0), 5.0 * largest(change));  // others follow through the gain
}

TEST(FaultyUpdate, CrossNotUpdatedLeavesTheCrossCovarianceOnly) {
  const Beside a = act("cross-not-updated", Act::update);
  const auto rest = a.before.size() - 3;
  const auto cross = [&](const EkfState& s) { return symmetric(s).topRightCorner(3, rest).eval(); };
  EXPECT_EQ(largest(cross(a.faulty) - cross(a.before)), 0.0);
  EXPECT_GT(largest(cross(a.lawful) - cross(a.before)), 1e-7);
  EXPECT_EQ(largest((symmetric(a.faulty) - symmetric(a.lawful)).bottomRightCorner(rest, rest)),
            0.0);
}

TEST(FaultyUpdate, DiagonalOnlyUpdatesBlocksOfTheDiagonal) {
  const Beside a = act("diagonal-only", Act::update);
  Eigen::MatrixXd change = symmetric(a.faulty) - symmetric(a.before);
  const Eigen::MatrixXd error = symmetric(a.faulty) - symmetric(a.lawful);
  EXPECT_EQ(largest(error.topLeftCorner(3, 3)), 0.0);
  change.topLeftCorner(3, 3).setZero();
  for (int row = 3; row < a.before.size(); row += 2) {
    EXPECT_EQ(largest(error.block(row, row, 2, 2)), 0.0);
    change.block(row, row, 2, 2).setZero();
  }
  EXPECT_EQ(largest(change), 0.0);
  EXPECT_GT(largest(error), 1e-7);
}

TEST(FaultyUpdate, SinglePrecisionIsRightToSixDigitsAndNotSymmetric) {
  const Beside a = act("single-precision", Act::update);
  const double scale = largest(symmetric(a.lawful));
  EXPECT_LT(largest(a.faulty.P - symmetric(a.lawful)), 1e-5 * scale);
  EXPECT_GT(largest(a.faulty.P - symmetric(a.lawful)), 1e-9 * scale);
  EXPECT_GT(largest(a.faulty.P - a.faulty.P.transpose()), 1e-9 * scale);
  EXPECT_EQ(largest(a.faulty.P - a.faulty.P.cast<float>().cast<double>()), 0.0);
}

TEST(FaultyUpdate, ObservedTwiceIsASecondUpdateWithTheFirstObservation) {
  const Beside a = act("observed-twice", Act::update);
  EkfState twice = a.lawful;
  const std::vector<Observation> first{readingOf(a.before, 4, {0.05, -0.03})};
  makeFault("none")->update(twice, first);
  EXPECT_EQ(largest(symmetric(twice) - symmetric(a.faulty)), 0.0);
  EXPECT_EQ(largest(twice.x - a.faulty.x), 0.0);
  EXPECT_GT(largest(symmetric(a.lawful) - symmetric(a.faulty)), 1e-7);
}

TEST(FaultyInnovation, SignAndWrap) {
  EkfState state = healthyState();
  const int row = 3;
  const Eigen::Vector2d z(1.0, 0.2);
  const auto innovation = [&](const char* fault) -> Eigen::Vector2d {
    return makeFault(fault)->innovation(state, row, z);
  };
  const Eigen::Vector2d lawful = innovation("none");
  EXPECT_EQ(largest(innovation("innovation-sign") + lawful), 0.0);
  const double turns = (innovation("innovation-unwrapped") - lawful)[1] / (2 * std::numbers::pi);
  EXPECT_NEAR(turns, std::round(turns), 1e-12);
  // A robot that faces −x with the feature just behind ±π.
  state.x.head<3>() = Eigen::Vector3d(0.0, 0.0, 3.1);
  state.x.segment<2>(row) = Eigen::Vector2d(-1.0, -0.1);
  EXPECT_NEAR(std::abs((innovation("innovation-unwrapped") - innovation("none"))[1]),
              2 * std::numbers::pi, 1e-12);
}

TEST(FaultyNoise, IsTheOneOfItsName) {
  const auto noise = [&](const char* fault) -> Eigen::Matrix2d {
    return makeFault(fault)->observationNoise(kNoise);
  };
  const double degrees = 180.0 / std::numbers::pi;
  EXPECT_LT(
      largest(noise("noise-sigma") - Eigen::Matrix2d(Eigen::Vector2d(0.06, 0.04).asDiagonal())),
      1e-15);
  EXPECT_DOUBLE_EQ(noise("noise-degrees")(1, 1), kNoise(1, 1) * degrees * degrees);
  EXPECT_DOUBLE_EQ(noise("noise-degrees")(0, 0), kNoise(0, 0));
  EXPECT_EQ(largest(noise("noise-9x") - 9.0 * kNoise), 0.0);
  EXPECT_EQ(largest(noise("none") - kNoise), 0.0);
}

TEST(FaultyAssociation, TakesOneReadingInTenForTheNearestNeighbour) {
  const EkfState state = healthyState();
  const auto equations = makeFault("wrong-association", {Sensor::range_bearing, {}, 7});
  const std::vector<Observation> readings{readingOf(state, 4, Eigen::Vector2d::Zero())};
  int wrong = 0;
  FeatureId taken_for = 0;
  for (int k = 0; k < 4000; ++k) {
    const Observation perceived = equations->perceive(state, readings).front();
    if (perceived.id == readings.front().id) continue;
    ++wrong;
    taken_for = perceived.id;
  }
  EXPECT_NEAR(wrong, 400, 4 * 19);  // binomial, 4 σ
  const Eigen::Vector2d own = state.x.segment<2>(3 + 2 * 4);
  const double chosen = (state.x.segment<2>(state.rowOf(taken_for).value()) - own).norm();
  for (int row = 3; row < state.size(); row += 2) {
    const double distance = (state.x.segment<2>(row) - own).norm();
    EXPECT_TRUE(distance == 0.0 || distance >= chosen);
  }
}

TEST(FaultyAssociation, MixesUpTwoReadingsAndNeverReadsAFeatureTwice) {
  const EkfState state = healthyState();
  const auto equations = makeFault("wrong-association", {Sensor::range_bearing, {}, 7});
  std::vector<Observation> readings;
  for (int index = 0; index < 6; ++index) {
    readings.push_back(readingOf(state, index, Eigen::Vector2d::Zero()));
  }
  int wrong = 0;
  for (int k = 0; k < 1000; ++k) {
    std::set<FeatureId> ids;
    for (const Observation& o : equations->perceive(state, readings)) {
      const auto index = static_cast<std::size_t>(ids.size());
      wrong += o.id != readings[index].id ? 1 : 0;
      ids.insert(o.id);
    }
    ASSERT_EQ(ids.size(), readings.size());
  }
  EXPECT_NEAR(wrong / 6000.0, 0.1, 0.03);  // mutual neighbours may be swapped back
}

TEST(FaultyWorld, AMovedFeatureJumpsHalfWayAndTheOthersStay) {
  SimulationOptions options;
  options.fault = "moved-feature";
  options.loops = 1;
  Simulation simulation(options);
  simulation.step();
  const Truth start = simulation.truth();
  while (simulation.progress() < 0.49) simulation.step();
  EXPECT_EQ(simulation.truth().features, start.features);
  while (simulation.step()) {
  }
  ASSERT_EQ(simulation.faultFeatures(), std::vector<FeatureId>{8});
  for (std::size_t k = 0; k < start.ids.size(); ++k) {
    const double moved = (simulation.truth().features[k] - start.features[k]).norm();
    EXPECT_NEAR(moved, start.ids[k] == 8 ? 0.3 : 0.0, 1e-15);
  }
}

}  // namespace
}  // namespace slamscope::slam
