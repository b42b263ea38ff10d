// SPDX-License-Identifier: MIT
#include "tests/bench/pair_map.hpp"

#include <cmath>
#include <random>

#include "tests/bench/ellipsoid_floor.hpp"

namespace slamscope::engine {

std::vector<View> aboveFloor(std::size_t count) {
  const View view = overFloor(kBenchCamera);
  std::vector<View> eyes(count, view);
  if (count > 1) eyes[1].T_eye_scene.pretranslate(Eigen::Vector3d(-0.064, 0.0, 0.0));
  return eyes;
}

PairGlyphs mapOf(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector2d> means;
  for (int i = 0; i < n; ++i) means.emplace_back(place(random), place(random));
  const double sigma =
      0.056 / std::sqrt(n);  // m, of a feature in what it has in common with others
  Eigen::MatrixXd root(2 * n, 6);
  for (int k = 0; k < root.size(); ++k) root(k) = sigma * normal(random) / std::sqrt(6.0);
  std::vector<double> packed;
  for (int row = 0; row < 2 * n; ++row) {
    for (int column = 0; column < row; ++column) {
      packed.push_back(root.row(row).dot(root.row(column)));
    }
    packed.push_back(root.row(row).squaredNorm() + 0.04 * sigma * sigma);
  }
  return {.points = std::make_shared<PlanarPoints>(means, packed),
          .axis = {.gain = 3.0},
          .choice = {},
          .colour = {0.9F, 0.1F, 0.1F, 1.0F}};
}

}  // namespace slamscope::engine
