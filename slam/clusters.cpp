// SPDX-License-Identifier: MIT
#include "slam/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace slamscope::slam {
namespace {

/// Disjoint sets of 0 … n − 1; the representative is the smallest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int k) {
    while (parent(k) != k) k = parent(k) = parent(parent(k));
    return k;
  }
  void unite(int a, int b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent(high) = low;
  }

 private:
  int& parent(int k) { return parent_[static_cast<std::size_t>(k)]; }
  std::vector<int> parent_;
};

Clustering clusteringOf(Sets& sets, std::size_t count, double cut) {
  Clustering result;
  result.cut = cut;
  result.label.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const auto first = static_cast<std::size_t>(sets.find(static_cast<int>(k)));
    if (first == k) {
      result.label[k] = result.count();
      result.members.emplace_back();
    } else {
      result.label[k] = result.label[first];
    }
    result.members[static_cast<std::size_t>(result.label[k])].push_back(static_cast<int>(k));
  }
  return result;
}

/// How many times longer the edge after the `below` shortest ones is than the longest of them.
double gapRatio(std::span<const Edge> tree, std::size_t below) {
  if (below == 0 || below >= tree.size()) return 0.0;
  const double low = tree[below - 1].length;
  return low > 0.0 ? tree[below].length / low : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Edge> minimumSpanningTree(std::span<const Eigen::Vector2d> points) {
  std::vector<Edge> tree;
  if (points.size() < 2) return tree;
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  std::vector<int> nearest(points.size(), 0);
  std::vector<bool> inside(points.size(), false);
  std::size_t added = 0;
  for (std::size_t count = 1; count < points.size(); ++count) {
    inside[added] = true;
    std::size_t next = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (inside[k]) continue;
      const double d = (points[k] - points[added]).norm();
      if (d < distance[k]) {
        distance[k] = d;
        nearest[k] = static_cast<int>(added);
      }
      if (distance[k] <= shortest) {
        shortest = distance[k];
        next = k;
      }
    }
    tree.push_back({nearest[next], static_cast<int>(next), shortest});
    added = next;
  }
  std::sort(tree.begin(), tree.end(),
            [](const Edge& a, const Edge& b) { return a.length < b.length; });
  return tree;
}

double defaultCut(std::span<const Edge> tree, std::optional<double> held) {
  if (tree.empty()) return 1.0;  // one feature: any distance will do
  const auto edges_below = [&](double cut) {
    return static_cast<std::size_t>(
        std::count_if(tree.begin(), tree.end(), [&](const Edge& e) { return e.length <= cut; }));
  };
  if (held && gapRatio(tree, edges_below(*held)) >= kHeldGapRatio) return *held;
  const std::size_t points = tree.size() + 1;
  std::size_t best = 0;
  double best_ratio = kGapRatio;
  for (std::size_t clusters = 2; 3 * clusters <= points; ++clusters) {
    const std::size_t below = points - clusters;
    if (gapRatio(tree, below) >= best_ratio) {
      best_ratio = gapRatio(tree, below);
      best = below;
    }
  }
  if (best == 0) return kGapRatio * tree.back().length;  // one cluster
  return std::sqrt(tree[best - 1].length * tree[best].length);
}

Clustering clusterAt(std::span<const Eigen::Vector2d> points, double cut) {
  Sets sets(points.size());
  for (const Edge& edge : minimumSpanningTree(points)) {
    if (edge.length <= cut) sets.unite(edge.i, edge.j);
  }
  return clusteringOf(sets, points.size(), cut);
}

ClusterTracker::ClusterTracker(std::optional<double> cut) : user_cut_(cut) {
  if (cut && !(*cut > 0.0)) {
    throw std::invalid_argument("the cut between clusters must be positive, got " +
                                std::to_string(*cut) + " m");
  }
}

std::vector<int> ClusterTracker::previousLabels(const Snapshot& snapshot) const {
  std::vector<int> labels(snapshot.ids.size(), -1);
  std::vector<std::pair<FeatureId, int>> known;
  for (std::size_t k = 0; k < ids_.size(); ++k) known.emplace_back(ids_[k], current_.label[k]);
  std::sort(known.begin(), known.end());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const auto found = std::lower_bound(known.begin(), known.end(), std::pair{snapshot.ids[k], -1});
    if (found != known.end() && found->first == snapshot.ids[k]) labels[k] = found->second;
  }
  return labels;
}

const Clustering& ClusterTracker::update(const Snapshot& snapshot) {
  const std::vector<Eigen::Vector2d>& points = snapshot.features;
  const std::vector<int> before = previousLabels(snapshot);
  const bool features_changed = ids_ != snapshot.ids;
  const std::optional<double> held =
      features_changed ? std::nullopt : std::optional<double>(current_.cut);
  const double cut =
      user_cut_.value_or(0.0) > 0.0 ? *user_cut_ : defaultCut(minimumSpanningTree(points), held);
  Sets sets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const bool both_known = before[i] >= 0 && before[j] >= 0;
      const double slack = !both_known ? 0.0 : before[i] == before[j] ? kHysteresis : -kHysteresis;
      if ((points[i] - points[j]).norm() <= cut * (1.0 + slack)) {
        sets.unite(static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
  current_ = clusteringOf(sets, points.size(), cut);
  current_.automatic = !user_cut_;
  current_.features_changed = features_changed;
  for (std::size_t i = 0; i < points.size() && !current_.repartitioned; ++i) {
    for (std::size_t j = i + 1; j < points.size() && !current_.repartitioned; ++j) {
      if (before[i] < 0 || before[j] < 0) continue;
      current_.repartitioned = (before[i] == before[j]) != (current_.label[i] == current_.label[j]);
    }
  }
  ids_ = snapshot.ids;
  return current_;
}

}  // namespace slamscope::slam
