// SPDX-License-Identifier: MIT
#include "slam/hypothesis.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "slam/angle.hpp"

namespace slamscope::slam {
namespace {

std::pair<FeatureId, FeatureId> inOrder(FeatureId a, FeatureId b) {
  return std::minmax(a, b);
}

/// P (e_a − e_b), N×2, of the features at rows a and b, from the lower triangle of P.
Eigen::Matrix<double, Eigen::Dynamic, 2> covarianceWithDistance(const EkfState& state, int a,
                                                                int b) {
  Eigen::Matrix<double, Eigen::Dynamic, 2> difference =
      Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(state.size(), 2);
  difference.middleRows<2>(a).setIdentity();
  difference.middleRows<2>(b) = -Eigen::Matrix2d::Identity();
  return state.P.selfadjointView<Eigen::Lower>() * difference;
}

Eigen::Vector2d featureAt(const EkfState& state, std::size_t index) {
  return state.x.segment<2>(Snapshot::row(static_cast<int>(index)));
}

}  // namespace

Decision::~Decision() {
  std::shared_ptr<Decision> oldest = std::move(before);
  while (oldest && oldest.use_count() == 1) {
    std::shared_ptr<Decision> older = std::move(oldest->before);
    oldest = std::move(older);
  }
}

Hypothesis Hypothesis::atOrigin(const Eigen::Vector3d& initial_sigma) {
  Hypothesis hypothesis;
  hypothesis.state.x = Eigen::Vector3d::Zero();
  hypothesis.state.P = initial_sigma.cwiseAbs2().asDiagonal();
  return hypothesis;
}

bool Hypothesis::sawNow(FeatureId feature) const {
  return std::find(seen_now.begin(), seen_now.end(), feature) != seen_now.end();
}

bool Hypothesis::sawTogether(FeatureId a, FeatureId b) const {
  return std::binary_search(together.begin(), together.end(), inOrder(a, b));
}

void Hypothesis::pair(EkfEquations& equations, std::size_t index, const Reading& reading) {
  const FeatureId feature = state.ids[index];
  Observation observation = reading.observation;
  observation.id = feature;
  equations.reuse(equations.update(state, {&observation, 1}));
  const int row = Snapshot::row(static_cast<int>(index));
  const double error = equations.innovation(state, row, observation.z)[0];  // after the update
  memories[index].last = reading.time;
  memories[index].last_error = error;
  seen_now.push_back(feature);
  newest = std::make_shared<Decision>(newest, reading.number, feature);
}

void Hypothesis::begin(EkfEquations& equations, const Reading& reading) {
  const FeatureId feature = reading.observation.id;
  equations.initialise(state, reading.observation);
  memories.push_back({reading.time});
  seen_now.push_back(feature);
  newest = std::make_shared<Decision>(newest, reading.number, feature);
}

void Hypothesis::endTime() {
  for (std::size_t k = 0; k < seen_now.size(); ++k) {
    for (std::size_t j = 0; j < k; ++j) {
      const auto both = inOrder(seen_now[k], seen_now[j]);
      const auto place = std::lower_bound(together.begin(), together.end(), both);
      if (place == together.end() || *place != both) together.insert(place, both);
    }
  }
}

Hypothesis::Distance Hypothesis::distance(std::size_t a, std::size_t b) const {
  const int row_a = Snapshot::row(static_cast<int>(a));
  const int row_b = Snapshot::row(static_cast<int>(b));
  const auto own = [this](int row) -> Eigen::Matrix2d {
    return state.P.block<2, 2>(row, row).selfadjointView<Eigen::Lower>();
  };
  const Eigen::Matrix2d cross = state.P.block<2, 2>(std::max(row_a, row_b), std::min(row_a, row_b));
  return {featureAt(state, a) - featureAt(state, b),
          own(row_a) + own(row_b) - cross - cross.transpose()};
}

void Hypothesis::join(std::size_t stays, std::size_t goes, const Distance& apart) {
  const Eigen::Matrix<double, Eigen::Dynamic, 2> PHt = covarianceWithDistance(
      state, Snapshot::row(static_cast<int>(stays)), Snapshot::row(static_cast<int>(goes)));
  const Eigen::Matrix<double, Eigen::Dynamic, 2> W = PHt * apart.covariance.inverse();
  state.x -= W * apart.mean;
  state.x[2] = wrapAngle(state.x[2]);
  state.P.triangularView<Eigen::Lower>() -= W * PHt.transpose();

  const FeatureId gone = state.ids[goes];
  const FeatureId left = state.ids[stays];
  if (memories[goes].last > memories[stays].last) {
    memories[stays].last = memories[goes].last;
    memories[stays].last_error = memories[goes].last_error;
  }
  for (auto& [a, b] : together) {
    const auto renamed = inOrder(a == gone ? left : a, b == gone ? left : b);
    a = renamed.first;
    b = renamed.second;
  }
  std::sort(together.begin(), together.end());
  together.erase(std::unique(together.begin(), together.end()), together.end());
  std::replace(seen_now.begin(), seen_now.end(), gone, left);
  newest = std::make_shared<Decision>(newest, Decision::kJoin, gone, left);
  state.removeAt(Snapshot::row(static_cast<int>(goes)));
  memories.erase(memories.begin() + static_cast<std::ptrdiff_t>(goes));
}

/// From the newest decision back, so that a join is known before what it renames.
std::vector<FeatureId> Hypothesis::labels(std::size_t count) const {
  std::vector<FeatureId> labels(count, 0);
  std::map<FeatureId, FeatureId> joined;
  for (const Decision* decision = newest.get(); decision; decision = decision->before.get()) {
    FeatureId name = decision->reading == Decision::kJoin ? decision->into : decision->feature;
    if (const auto other = joined.find(name); other != joined.end()) name = other->second;
    if (decision->reading == Decision::kJoin) {
      joined[decision->feature] = name;
    } else {
      labels.at(decision->reading) = name;
    }
  }
  return labels;
}

bool alike(const Hypothesis& a, const Hypothesis& b, const Likeness& likeness) {
  if (a.state.featureCount() != b.state.featureCount()) return false;
  Eigen::Vector3d moved = a.state.pose() - b.state.pose();
  moved[2] = wrapAngle(moved[2]);
  const Eigen::Matrix3d P_vv = a.state.P.topLeftCorner<3, 3>().selfadjointView<Eigen::Lower>();
  const Eigen::Matrix3d pose_floor = 1e-6 * Eigen::Matrix3d::Identity();
  if (!(moved.dot((P_vv + pose_floor).inverse() * moved) <= likeness.pose)) return false;

  std::vector<bool> taken(b.memories.size(), false);
  for (std::size_t k = 0; k < a.memories.size(); ++k) {
    std::size_t nearest = taken.size();
    Eigen::Vector2d apart = Eigen::Vector2d::Zero();
    for (std::size_t j = 0; j < taken.size(); ++j) {
      const Eigen::Vector2d d = featureAt(a.state, k) - featureAt(b.state, j);
      if (taken[j] || (nearest < taken.size() && d.norm() >= apart.norm())) continue;
      nearest = j;
      apart = d;
    }
    const int row = Snapshot::row(static_cast<int>(k));
    const Eigen::Matrix2d P_ff = a.state.P.block<2, 2>(row, row).selfadjointView<Eigen::Lower>();
    const Eigen::Matrix2d feature_floor = 1e-4 * Eigen::Matrix2d::Identity();
    if (!(apart.dot((P_ff + feature_floor).inverse() * apart) <= likeness.feature)) return false;
    taken[nearest] = true;
  }
  return true;
}

}  // namespace slamscope::slam
