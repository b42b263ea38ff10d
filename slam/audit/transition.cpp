// SPDX-License-Identifier: MIT
#include "slam/audit/transition.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <unordered_map>

#include "slam/angle.hpp"
#include "slam/audit/packed_change.hpp"

namespace slamscope::slam {
namespace {

/// The snapshot with only the features at `places`, in that order.
SnapshotPtr rearranged(const Snapshot& snapshot, const std::vector<int>& places) {
  auto result = std::make_shared<Snapshot>();
  result->time = snapshot.time;
  result->sequence = snapshot.sequence;
  result->event = snapshot.event;
  result->pose = snapshot.pose;
  result->diagonal_only = snapshot.diagonal_only;
  result->observed = snapshot.observed;
  result->observed_given = snapshot.observed_given;
  result->observations = snapshot.observations;
  std::vector<int> states{0, 1, 2};
  for (const int place : places) {
    result->ids.push_back(snapshot.ids[static_cast<std::size_t>(place)]);
    result->features.push_back(snapshot.features[static_cast<std::size_t>(place)]);
    states.push_back(Snapshot::row(place));
    states.push_back(Snapshot::row(place) + 1);
  }
  const int size = static_cast<int>(states.size());
  PackedCovariance P(size);
  for (int row = 0; row < size; ++row) {
    for (int col = 0; col <= row; ++col) {
      P(row, col) = snapshot.covariance(states[static_cast<std::size_t>(row)],
                                        states[static_cast<std::size_t>(col)]);
    }
  }
  result->covariance = std::move(P);
  return result;
}

int sharedPrefix(const Snapshot& a, const Snapshot& b) {
  if (a.ids == b.ids) return a.featureCount();  // nearly always, and a comparison of memory
  return static_cast<int>(
      std::mismatch(a.ids.begin(), a.ids.end(), b.ids.begin(), b.ids.end()).first - a.ids.begin());
}

}  // namespace

Eigen::VectorXd Transition::meanChange() const {
  Eigen::VectorXd change(size());
  change.head<3>() = after->pose - before->pose;
  change[2] = wrapAngle(change[2]);
  for (int i = 0; i < shared; ++i) {
    const auto k = static_cast<std::size_t>(i);
    change.segment<2>(Snapshot::row(i)) = after->features[k] - before->features[k];
  }
  return change;
}

Eigen::VectorXd Transition::scaledColumn(int column) const {
  Eigen::VectorXd result(size());
  const std::span<const double> packed = before->covariance.packed();
  const auto c = static_cast<std::size_t>(column);
  const std::size_t start = c * (c + 1) / 2;
  for (std::size_t j = 0; j < c; ++j) result[static_cast<Eigen::Index>(j)] = packed[start + j];
  std::size_t place = start + c;
  for (std::size_t j = c; j < static_cast<std::size_t>(size()); ++j) {
    result[static_cast<Eigen::Index>(j)] = packed[place];
    place += j + 1;
  }
  return result.cwiseProduct(scale);
}

Eigen::MatrixXd Transition::scaledBlock(const std::vector<int>& states) const {
  const auto count = static_cast<Eigen::Index>(states.size());
  Eigen::MatrixXd block(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      block(i, j) = block(j, i) =
          change(states[static_cast<std::size_t>(i)], states[static_cast<std::size_t>(j)]);
    }
  }
  return block;
}

Transition lineUp(const SnapshotPtr& before, const SnapshotPtr& after, const Exactness& exactness) {
  Transition t;
  t.before = before;
  t.after = after;
  t.shared = sharedPrefix(*before, *after);
  if (t.shared < before->featureCount()) {  // something was removed or re-ordered
    std::unordered_map<FeatureId, int> place;
    for (int k = 0; k < after->featureCount(); ++k)
      place[after->ids[static_cast<std::size_t>(k)]] = k;
    std::vector<int> in_before;
    std::vector<int> in_after;
    for (int k = 0; k < before->featureCount(); ++k) {
      const auto found = place.find(before->ids[static_cast<std::size_t>(k)]);
      if (found == place.end()) continue;
      in_before.push_back(k);
      in_after.push_back(found->second);
      place.erase(found);
    }
    t.shared = static_cast<int>(in_before.size());
    for (int k = 0; k < after->featureCount(); ++k) {
      if (place.contains(after->ids[static_cast<std::size_t>(k)])) in_after.push_back(k);
    }
    t.before = rearranged(*before, in_before);
    t.after = rearranged(*after, in_after);
  }
  t.sigma.resize(t.size());
  t.scale.resize(t.size());
  constexpr double kLeastSigma = 1e-100;
  for (int i = 0; i < t.size(); ++i) t.sigma[i] = t.before->covariance(i, i);
  // All at once: roots and reciprocals one by one took longer than all else in here.
  t.sigma = t.sigma.array().max(0.0).sqrt();
  t.scale = t.sigma.array().max(kLeastSigma).inverse();
  t.largest_scale = t.scale.maxCoeff();
  if (t.largest_scale >= 1.0 / kLeastSigma) {
    t.scale = (t.sigma.array() > kLeastSigma).select(t.scale, 0.0);
    t.largest_scale = t.scale.maxCoeff();
  }
  t.noise = exactness.covariance;
  if (exactness.covariance_absolute > 0.0) {
    t.noise += exactness.covariance_absolute * t.largest_scale * t.largest_scale;
  }
  double largest = t.before->pose.cwiseAbs().maxCoeff();
  for (const Eigen::Vector2d& f : t.before->features) {
    largest = std::max(largest, f.cwiseAbs().maxCoeff());
  }
  t.mean_noise = exactness.mean * largest + exactness.mean_absolute;
  t.rounded = exactness.rounded;
  t.observed_given = after->observed_given;
  if (after->observed_given) {
    for (int i = 0; i < t.shared; ++i) {
      if (std::find(after->observed.begin(), after->observed.end(), t.id(i)) !=
          after->observed.end()) {
        t.observed.push_back(i);
      }
    }
  }
  return t;
}

Eigen::MatrixXd changeTimes(const Transition& transition, int begin, const Eigen::MatrixXd& W) {
  const int rows = transition.size() - begin;
  const Eigen::VectorXd scale = transition.scale.tail(rows);
  const Eigen::MatrixXd input = scale.asDiagonal() * W;
  Eigen::MatrixXd output = Eigen::MatrixXd::Zero(rows, W.cols());
  const PackedChange D{transition.before->covariance.packed().data(),
                       transition.after->covariance.packed().data(), begin};
  for (Eigen::Index k = 0; k < W.cols(); ++k) {
    addImage(D, 0, rows, input.col(k).data(), output.col(k).data());
  }
  return scale.asDiagonal() * output;
}

void fillProbes(std::uint64_t seed, Eigen::Index rows, Eigen::Index count, Eigen::MatrixXd& W) {
  // Numbers by their place (Steele et al. 2014, "Fast splittable pseudorandom number generators"):
  // no generator has to be started for the few that a record needs.
  constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;
  std::uint64_t place = (seed + 0x5eed) * 0xd1342543de82ef95;
  W.resize(rows, count);
  for (Eigen::Index k = 0; k < W.size(); ++k) {
    std::uint64_t bits = place += kStep;
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111eb;
    bits ^= bits >> 31U;
    const double size = 0.5 + static_cast<double>(bits >> 12U) * 0x1.0p-52;
    W(k) = (bits & 1U) != 0 ? size : -size;
  }
}

}  // namespace slamscope::slam
