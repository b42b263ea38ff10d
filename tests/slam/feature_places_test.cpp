// SPDX-License-Identifier: MIT
#include "slam/formats/feature_places.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace slamscope::slam {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A state of n places; those of `blank` are filled with `filler`, the others with numbers.
struct State {
  State(std::size_t places, const std::vector<std::size_t>& blank, double filler = kNan)
      : size(3 + 2 * places), x(size, 0.5), P(size * size, 0.1) {
    for (const std::size_t place : blank) {
      for (std::size_t row = 3 + 2 * place; row < 5 + 2 * place; ++row) {
        x[row] = filler;
        for (std::size_t k = 0; k < size; ++k) P[row * size + k] = P[k * size + row] = filler;
      }
    }
  }
  double& p(std::size_t row, std::size_t col) { return P[row * size + col]; }

  std::size_t size;
  std::vector<double> x, P;
};

std::vector<int> find(FeaturePlaces& places, const State& state) {
  return places.find(state.x, state.P, state.size);
}

using Places = std::vector<int>;

TEST(FeaturePlaces, NanInMeanAndAllRowsAndColumnsIsPadding) {
  FeaturePlaces places;
  EXPECT_EQ(find(places, State(3, {1, 2})), Places({0}));
  EXPECT_EQ(find(places, State(3, {2})), Places({0, 1}));
  EXPECT_EQ(find(places, State(3, {})), Places({0, 1, 2}));
}

TEST(FeaturePlaces, ZerosEverywhereArePaddingToo) {
  FeaturePlaces places;
  EXPECT_EQ(find(places, State(2, {1}, 0.0)), Places({0}));
}

TEST(FeaturePlaces, APlaceInTheMiddleMayBeEmptyUntilItsFeatureIsSeen) {
  FeaturePlaces places;
  EXPECT_EQ(find(places, State(3, {0, 1})), Places({2}));
  EXPECT_EQ(find(places, State(3, {1})), Places({0, 2}));
}

TEST(FeaturePlaces, OneNumberAmongTheNansMakesItAFeature) {
  for (int what = 0; what < 4; ++what) {
    State state(2, {1});
    if (what == 0) state.x[5] = 1.0;
    if (what == 1) state.p(6, 0) = 0.1;
    if (what == 2) state.p(4, 5) = 0.1;
    if (what == 3) state.p(6, 5) = 0.1;
    FeaturePlaces places;
    EXPECT_EQ(find(places, state), Places({0, 1})) << what;
  }
}

TEST(FeaturePlaces, ANanWithinAFeatureIsNoPadding) {
  State state(2, {});
  state.p(5, 6) = state.x[5] = kNan;
  FeaturePlaces places;
  EXPECT_EQ(find(places, state), Places({0, 1}));
}

TEST(FeaturePlaces, AFilterThatBecameNanKeepsItsFeatures) {
  FeaturePlaces places;
  EXPECT_EQ(find(places, State(2, {1})), Places({0}));
  State diverged(2, {0, 1});
  diverged.x.assign(diverged.size, kNan);
  diverged.P.assign(diverged.P.size(), kNan);
  EXPECT_EQ(find(places, diverged), Places({0}));
}

TEST(FeaturePlaces, AFeatureThatLeavesWithoutIdsIsUnreadable) {
  FeaturePlaces places;
  EXPECT_EQ(find(places, State(2, {})), Places({0, 1}));
  EXPECT_THROW(find(places, State(2, {1})), std::runtime_error);
  FeaturePlaces shorter;
  EXPECT_EQ(find(shorter, State(2, {})), Places({0, 1}));
  EXPECT_THROW(find(shorter, State(1, {})), std::runtime_error);
}

TEST(FeaturePlaces, AreFoundInTheDiagonalAndWithoutMeans) {
  const State state(2, {1});
  std::vector<double> diagonal;
  for (std::size_t k = 0; k < state.size; ++k) diagonal.push_back(state.P[k * state.size + k]);
  FeaturePlaces of_diagonal, of_covariance;
  EXPECT_EQ(of_diagonal.find(state.x, diagonal, state.size), Places({0}));
  EXPECT_EQ(of_covariance.find({}, state.P, state.size), Places({0}));
}

}  // namespace
}  // namespace slamscope::slam
