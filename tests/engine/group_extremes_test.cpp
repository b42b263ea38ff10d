// SPDX-License-Identifier: MIT
#include "engine/render/group_extremes.hpp"

#include <numeric>

#include "engine/scene/pair_ellipsoid.hpp"
#include "tests/engine/pair_scene.hpp"

// What the device sums pairs of points up in, against double precision.
namespace slamscope::engine {
namespace {

class GroupExtremesTest : public ::testing::Test {
 protected:
  void SetUp() override { gpu_ = std::make_shared<Gpu>(GpuOptions{.validation = true}); }
  void TearDown() override {
    for (const std::string& message : gpu_->validationMessages()) ADD_FAILURE() << message;
  }
  std::shared_ptr<Gpu> gpu_;
};

double areaOfPair(const PlanarPoints& points, std::pair<std::uint32_t, std::uint32_t> pair) {
  return std::sqrt(differenceCovariance(points, pair.first, pair.second).determinant());
}

/// How far a result is from what double precision makes of all pairs, relative.
double misfitOf(const GroupPair& found, const PlanarPoints& points,
                const std::vector<std::uint32_t>& groups) {
  double least = 1e300;
  double greatest = 0.0;
  double count = 0.0;
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (std::uint32_t j = 1; j < groups.size(); ++j) {
    for (std::uint32_t i = 0; i < j; ++i) {
      if (std::minmax(groups[i], groups[j]) != std::minmax(found.a, found.b)) continue;
      const double area = areaOfPair(points, {i, j});
      least = std::min(least, area);
      greatest = std::max(greatest, area);
      sum += differenceCovariance(points, i, j);
      count += 1.0;
    }
  }
  return std::max({std::abs(areaOfPair(points, found.least) / least - 1.0),
                   std::abs(areaOfPair(points, found.greatest) / greatest - 1.0),
                   (found.mean - sum / count).norm() / (sum / count).norm()});
}

TEST_F(GroupExtremesTest, AreThoseOfDoublePrecision) {
  GroupExtremes extremes(gpu_);
  for (const int n : {3, 40, 230}) {
    const PairGlyphs glyphs = someMap(n, 0.05);
    for (const std::uint32_t count : {2U, 3U, 11U}) {
      std::vector<std::uint32_t> groups;
      for (int i = 0; i < n; ++i) {
        groups.push_back(i < int(count) ? std::uint32_t(i) : std::uint32_t(i * i + i / 3) % count);
      }
      if (*std::ranges::max_element(groups) + 1 != count) continue;
      const auto found = extremes.find(glyphs.points, groups);
      ASSERT_EQ(found.size(), count * (count - 1) / 2);
      for (const GroupPair& pair : found) {
        EXPECT_LT(misfitOf(pair, *glyphs.points, groups), 1e-4) << n << ' ' << count;
        EXPECT_LT(pair.a, pair.b);
        EXPECT_LT(pair.least.first, pair.least.second);
      }
      // Twin: another map's pairs are others.
      const PairGlyphs other = someMap(n, 0.05, 4);
      EXPECT_GT(misfitOf(found.front(), *other.points, groups), 1e-3);
    }
  }
}

TEST_F(GroupExtremesTest, OfPointsEachOnItsOwnAreThePairsThemselves) {
  GroupExtremes extremes(gpu_);
  const PairGlyphs glyphs = someMap(90, 0.05);
  std::vector<std::uint32_t> groups(90);
  std::iota(groups.begin(), groups.end(), 0U);
  const auto found = extremes.find(glyphs.points, groups);
  ASSERT_EQ(found.size(), 4005U);
  for (const GroupPair& pair : found) {
    EXPECT_EQ(pair.least, std::pair(pair.a, pair.b));
    EXPECT_EQ(pair.greatest, std::pair(pair.a, pair.b));
  }
  const Eigen::Matrix2d P_d = differenceCovariance(*glyphs.points, 17, 58);
  const GroupPair& one = found[58 * 57 / 2 + 17];
  EXPECT_LT((one.mean - P_d).norm(), 1e-5 * P_d.norm());
}

TEST_F(GroupExtremesTest, AreNoneOfOneGroupAndNeedOneForEachPoint) {
  GroupExtremes extremes(gpu_);
  const PairGlyphs glyphs = someMap(4, 0.05);
  EXPECT_TRUE(extremes.find(glyphs.points, std::vector<std::uint32_t>(4, 0U)).empty());
  EXPECT_THROW((void)extremes.find(glyphs.points, std::vector<std::uint32_t>(3, 0U)),
               std::invalid_argument);
}

TEST_F(GroupExtremesTest, OfACovarianceThatNoBufferTakesAreRefused) {
  gpu_ = std::make_shared<Gpu>(GpuOptions{.validation = true, .most_texels = 9});
  GroupExtremes extremes(gpu_);
  EXPECT_THROW((void)extremes.find(someMap(4, 0.05).points, std::vector<std::uint32_t>{0, 1, 0, 1}),
               std::runtime_error);
}

}  // namespace
}  // namespace slamscope::engine
