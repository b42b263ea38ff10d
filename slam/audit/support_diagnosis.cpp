// SPDX-License-Identifier: MIT
#include "slam/audit/support_diagnosis.hpp"

#include <algorithm>
#include <cmath>

#include "slam/audit/change_range.hpp"

namespace slamscope::slam {
namespace {

/// Beyond this share outside of the span a filter is not just linearised in another way.
constexpr double kNearly = 0.05;
/// Beyond this share of a feature's distance nobody linearises, unless the point is one's exactly.
constexpr double kFar = 0.5, kExactly = 1e-6;
/// Rows that a span must leave over to prove anything.
constexpr int kSpareRows = 1;

struct WrongReading {
  std::string_view pattern;
  std::string_view allow;  ///< empty: a fault
  std::optional<Eigen::Vector2d> delta;
  double tolerance = 1e-3;  ///< of |δ − lawful δ| or of |δ|
  double misfit = 0.0;      ///< the largest so far, of the way from the lawful δ to the one used
};

std::optional<Eigen::Vector2d> at(const std::optional<Means>& means, FeatureId id) {
  if (!means) return std::nullopt;
  const std::optional<Eigen::Vector2d> l = means->feature(id);
  if (!l) return std::nullopt;
  return Eigen::Vector2d(*l - means->pose.head<2>());
}

std::vector<WrongReading> wrongReadings(const Transition& t, const LinearisationPoints& points,
                                        int i, const Eigen::Vector2d& lawful) {
  const FeatureId id = t.id(i);
  const auto k = static_cast<std::size_t>(i);
  std::vector<WrongReading> list;
  const auto first = points.first_estimates.find(id);
  if (first != points.first_estimates.end()) {
    const Eigen::Vector2d l = first->second;
    list.push_back({"first-estimate", "fej", l - t.before->pose.head<2>()});
    if (points.after_prediction) {
      list.push_back({"first-estimate", "fej", l - points.after_prediction->pose.head<2>()});
    }
  }
  list.push_back({"bearing-sign", "", -lawful});
  list.push_back({"bearing-one-over-q", "", lawful / lawful.squaredNorm()});
  list.push_back({"stale", "", at(points.before_prediction, id)});
  if (points.before_prediction) {
    list.push_back({"stale", "", t.before->features[k] - points.before_prediction->pose.head<2>()});
  }
  // An iterated update linearises close to where it ends, whatever made it stop.
  const Eigen::Vector2d after = t.after->features[k] - t.after->pose.head<2>();
  list.push_back({"iterated", "iterated", after, 0.35 * (after - lawful).norm() / lawful.norm()});
  return list;
}

/// Whether the candidate explains the δ that was used; not where it is hardly another than the
/// lawful one.
bool explains(const WrongReading& candidate, const Eigen::Vector2d& used,
              const Eigen::Vector2d& lawful) {
  if (!candidate.delta) return false;
  const double off = (used - *candidate.delta).norm();
  if (candidate.allow.empty() && off > 0.05 * (*candidate.delta - lawful).norm()) return false;
  return off <= candidate.tolerance * lawful.norm() && off < 0.5 * (used - lawful).norm();
}

/// Features were written outside the update: their rows taken out, all is whole.
bool writtenOutside(const Transition& t, UpdateAnatomy& anatomy) {
  anatomy.outside =
      culprits(t, anatomy.change, anatomy.basis, std::max(1, std::min(12, t.shared / 2)));
  if (anatomy.outside.empty()) return false;
  std::vector<int> features = anatomy.outside;
  std::erase(features, -1);
  for (const int i : features) {
    anatomy.support.blame.push_back({t.id(i), 1.0 / static_cast<double>(features.size())});
  }
  anatomy.support.patterns.emplace_back(features.empty() ? "robot-written" : "feature-written");
  return true;
}

/// Nothing but the blocks of robot and features changes.
bool diagonalBlocksOnly(const Transition& t) {
  int changed = 0;
  for (int i = 0; i < t.shared; ++i) {
    const int r = Snapshot::row(i);
    const int other = Snapshot::row((i + 1) % t.shared);
    const bool off = t.change(r, 0) != 0.0 || t.change(r + 1, 1) != 0.0 ||
                     (t.shared > 1 && t.change(r, other) != 0.0);
    if (off) return false;
    if (t.change(r, r) != 0.0) ++changed;
  }
  return changed > 1;
}

/// D_vm is zero, to the bit, while robot and map both change.
bool crossUntouched(const Transition& t) {
  for (int i = 3; i < t.size(); ++i) {
    for (int j = 0; j < 3; ++j) {
      if (t.change(i, j) != 0.0) return false;
    }
  }
  return t.change(2, 2) != 0.0 && t.shared > 1 && t.change(3, 5) != 0.0;
}

void blameShift(const Transition& t, int i, const Eigen::Vector2d& used,
                const Eigen::Vector2d& lawful, Outcome& support) {
  if (!support.evidence.empty()) return;
  const std::string of = " of feature " + std::to_string(t.id(i)) + " from the robot, in H";
  support.show("x" + of, used.x(), lawful.x());
  support.show("y" + of, used.y(), lawful.y());
}

/// The Jacobian has the right form, but at other places of the features from the robot.
bool linearisedElsewhere(const Transition& t, const LinearisationPoints& points,
                         const ChangeRange& range, UpdateAnatomy& anatomy) {
  std::optional<std::vector<WrongReading>> common;  // what explains every shift
  double farthest = 0.0;
  Outcome shown = anatomy.support;
  for (std::size_t k = 0; k < anatomy.observed.size(); ++k) {
    const int i = anatomy.observed[k];
    const Eigen::Vector2d lawful = anatomy.deltas[k];
    const std::optional<Eigen::Vector2d> used = linearisedAt(t, range, i);
    if (!used) return false;
    const double off = (*used - lawful).norm() / lawful.norm();
    farthest = std::max(farthest, off);
    if (off < 1e-5) continue;
    blameShift(t, i, *used, lawful, shown);
    std::vector<WrongReading> fitting = wrongReadings(t, points, i, lawful);
    std::erase_if(fitting, [&](const WrongReading& c) { return !explains(c, *used, lawful); });
    for (WrongReading& c : fitting) c.misfit = (*used - *c.delta).norm() / (*used - lawful).norm();
    if (!common) {
      common = std::move(fitting);
      continue;
    }
    std::erase_if(*common, [&](WrongReading& c) {
      const auto again = std::ranges::find(fitting, c.pattern, &WrongReading::pattern);
      if (again == fitting.end()) return true;
      c.misfit = std::max(c.misfit, again->misfit);
      return false;
    });
  }
  // Several may explain it by chance (where the last motion and the update happen to point the same
  // way): the one that does so best.
  const WrongReading* found = nullptr;
  if (common && !common->empty())
    found = &*std::ranges::min_element(*common, {}, &WrongReading::misfit);
  if (found == nullptr && farthest < kNearly) return false;  // explained by whoever asks next
  const bool near_enough = farthest < kFar || (found != nullptr && found->misfit < kExactly);
  if (found != nullptr && !found->allow.empty() && near_enough) {
    anatomy.allow = found->allow;
    anatomy.support = Outcome::notCheckable(
        "linearised elsewhere than at the mean, as with --allow " + std::string(found->allow));
    return true;
  }
  anatomy.support = std::move(shown);
  anatomy.support.patterns.emplace_back(found != nullptr ? found->pattern : "linearised-elsewhere");
  anatomy.support.amount = "the observation Jacobian was not taken at the mean before the update";
  return true;
}

/// H has the right numbers in another feature's block.
bool wrongBlock(const Transition& t, const ChangeRange& range, UpdateAnatomy& anatomy) {
  std::vector<int> written;
  for (std::size_t k = 0; k < anatomy.observed.size(); ++k) {
    // The block that fits best; several may within the noise of a nearly full range.
    int best = anatomy.observed[k];
    double least = shareOutside(t, range, best, anatomy.deltas[k]);
    for (int j = 0; j < t.shared; ++j) {
      const double share = shareOutside(t, range, j, anatomy.deltas[k]);
      if (share >= least) continue;
      least = share;
      best = j;
    }
    if (best == anatomy.observed[k] || !contains(t, range, best, anatomy.deltas[k])) continue;
    if (std::find(written.begin(), written.end(), best) == written.end()) written.push_back(best);
  }
  if (written.empty()) return false;
  for (const int j : written) {
    anatomy.support.blame.push_back({t.id(j), 1.0 / static_cast<double>(written.size())});
  }
  anatomy.support.patterns.emplace_back("wrong-block");
  anatomy.support.amount =
      "the observation of feature " + std::to_string(t.id(anatomy.observed[0])) +
      " is written to the block of feature " + std::to_string(t.id(written[0]));
  return true;
}

/// Heading, or position too, from outside: D ⊆ lawful span and P⁻e_θ (P⁻e_x, P⁻e_y).
bool somethingBesides(const Transition& t, UpdateAnatomy& anatomy) {
  SpanBasis absolute = anatomy.basis;
  for (const int state : {2, 0, 1}) {
    absolute.W.conservativeResize(Eigen::NoChange, absolute.W.cols() + 1);
    absolute.noise.conservativeResize(absolute.W.cols());
    absolute.W.rightCols<1>() = t.scaledColumn(state);
    absolute.noise[absolute.W.cols() - 1] = t.noise * t.sigma[state];
    if (absolute.W.cols() + kSpareRows > absolute.W.rows()) return false;
    if (state == 0 || !fitSpan(t, anatomy.change, absolute).whole) continue;
    anatomy.heading_besides = state == 2;
    anatomy.allow = "absolute-sensor";
    anatomy.support = Outcome::notCheckable(
        "something besides relative observations is used, as with --allow absolute-sensor");
    return true;
  }
  return false;
}

}  // namespace

void diagnoseSupport(const Transition& t, const LinearisationPoints& points,
                     UpdateAnatomy& anatomy) {
  anatomy.support.amount = "P changes outside of what the observed features span";
  const int rank = 2 * static_cast<int>(anatomy.observed.size());
  const ChangeRange range = rangeOfChange(t, rank, rank + 8);
  if (diagonalBlocksOnly(t)) {
    anatomy.support.patterns.emplace_back("diagonal-only");
    anatomy.support.amount = "P changes in blocks on the diagonal alone";
    return;
  }
  if (crossUntouched(t)) {
    anatomy.support.patterns.emplace_back("cross-not-updated");
    anatomy.support.amount = "P_vm does not change while P_vv and P_mm do";
    return;
  }
  if (range.complete && range.Q.cols() <= rank) {  // an update, with another H
    if (wrongBlock(t, range, anatomy)) return;
    if (linearisedElsewhere(t, points, range, anatomy)) return;
  } else if (somethingBesides(t, anatomy) || writtenOutside(t, anatomy)) {
    return;
  }
  if (anatomy.support.residual < kNearly) {
    anatomy.support = Outcome::notCheckable(
        "near the lawful span, not in it: linearised in another way than an EKF (UKF?)");
  }
}

}  // namespace slamscope::slam
