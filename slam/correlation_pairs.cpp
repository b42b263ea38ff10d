// SPDX-License-Identifier: MIT
#include "slam/correlation_pairs.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>

#include "slam/correlation.hpp"

namespace slamscope::slam {
namespace {

constexpr std::array<std::pair<PairMode, std::string_view>, 5> kModeNames{{
    {PairMode::all, "all"},
    {PairMode::between_clusters, "between-clusters"},
    {PairMode::min_mean_max, "min-mean-max"},
    {PairMode::selected, "selected"},
    {PairMode::alarms, "alarms"},
}};

template <typename Wanted>
std::vector<FeaturePair> pairsWhere(const Snapshot& snapshot, Wanted wanted) {
  std::vector<FeaturePair> pairs;
  for (int i = 0; i < snapshot.featureCount(); ++i) {
    for (int j = i + 1; j < snapshot.featureCount(); ++j) {
      if (wanted(static_cast<std::size_t>(i), static_cast<std::size_t>(j))) {
        pairs.push_back({i, j, relativeCovariance(snapshot, i, j)});
      }
    }
  }
  return pairs;
}

std::vector<FeaturePair> selectedPairs(const Snapshot& snapshot, std::span<const FeatureId> ids) {
  std::vector<bool> picked(snapshot.ids.size(), false);
  for (const FeatureId id : ids) {
    if (const auto index = snapshot.indexOf(id)) picked[static_cast<std::size_t>(*index)] = true;
  }
  return pairsWhere(snapshot, [&](std::size_t i, std::size_t j) { return picked[i] || picked[j]; });
}

std::vector<FeaturePair> alarmedPairs(const Snapshot& snapshot,
                                      std::span<const std::pair<FeatureId, FeatureId>> alarms) {
  std::vector<FeaturePair> pairs;
  for (const auto& [a, b] : alarms) {
    const auto i = snapshot.indexOf(a);
    const auto j = snapshot.indexOf(b);
    if (!i || !j || i == j) continue;
    const auto [low, high] = std::minmax(*i, *j);
    pairs.push_back({low, high, relativeCovariance(snapshot, low, high)});
  }
  return pairs;
}

ClusterPair summarise(const Snapshot& snapshot, const Clustering& clusters, int a, int b) {
  const std::vector<int>& members_a = clusters.members[static_cast<std::size_t>(a)];
  const std::vector<int>& members_b = clusters.members[static_cast<std::size_t>(b)];
  ClusterPair result;
  result.a = a;
  result.b = b;
  std::optional<double> least;
  std::optional<double> most;
  for (const int i : members_a) {
    for (const int j : members_b) {
      const FeaturePair pair{std::min(i, j), std::max(i, j), relativeCovariance(snapshot, i, j)};
      const double area = ellipseArea(pair.P_d);
      result.mean += pair.P_d;
      if (!least || area < *least) {
        least = area;
        result.minimum = pair;
      }
      if (!most || area > *most) {
        most = area;
        result.maximum = pair;
      }
    }
  }
  result.mean /= static_cast<double>(members_a.size() * members_b.size());
  return result;
}

}  // namespace

std::string_view pairModeName(PairMode mode) {
  return std::find_if(kModeNames.begin(), kModeNames.end(),
                      [mode](const auto& known) { return known.first == mode; })
      ->second;
}

PairMode pairModeFromName(std::string_view name) {
  for (const auto& [mode, known] : kModeNames) {
    if (known == name) return mode;
  }
  throw std::invalid_argument("no mode of the name '" + std::string(name) +
                              "'; known: all, between-clusters, min-mean-max, selected, alarms");
}

std::vector<Eigen::Vector2d> centroids(const Snapshot& snapshot, const Clustering& clusters) {
  std::vector<Eigen::Vector2d> means;
  for (const std::vector<int>& members : clusters.members) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const int k : members) sum += snapshot.features[static_cast<std::size_t>(k)];
    means.emplace_back(sum / static_cast<double>(members.size()));
  }
  return means;
}

PairSelection selectPairs(const Snapshot& snapshot, PairMode mode, const Clustering& clusters,
                          const PairChoice& choice) {
  PairSelection selection;
  if (snapshot.diagonal_only) return selection;
  const bool of_clusters = mode == PairMode::between_clusters || mode == PairMode::min_mean_max;
  if (of_clusters && clusters.label.size() != snapshot.ids.size()) {
    throw std::invalid_argument("clusters of " + std::to_string(clusters.label.size()) +
                                " features given for a snapshot of " +
                                std::to_string(snapshot.ids.size()));
  }
  switch (mode) {
    case PairMode::all:
      selection.pairs = pairsWhere(snapshot, [](std::size_t, std::size_t) { return true; });
      break;
    case PairMode::between_clusters:
      selection.pairs = pairsWhere(snapshot, [&](std::size_t i, std::size_t j) {
        return clusters.label[i] != clusters.label[j];
      });
      break;
    case PairMode::min_mean_max: {
      const std::vector<Eigen::Vector2d> centres = centroids(snapshot, clusters);
      for (int a = 0; a < clusters.count(); ++a) {
        for (int b = a + 1; b < clusters.count(); ++b) {
          ClusterPair pair = summarise(snapshot, clusters, a, b);
          pair.centroid_a = centres[static_cast<std::size_t>(a)];
          pair.centroid_b = centres[static_cast<std::size_t>(b)];
          selection.cluster_pairs.push_back(pair);
        }
      }
      break;
    }
    case PairMode::selected:
      selection.pairs = selectedPairs(snapshot, choice.selected);
      break;
    case PairMode::alarms:
      selection.pairs = alarmedPairs(snapshot, choice.alarms);
      break;
  }
  return selection;
}

}  // namespace slamscope::slam
