// SPDX-License-Identifier: MIT
#include "tracking/head_step.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace slamscope::tracking {
namespace {

using Eigen::Isometry3d;
using std::chrono::nanoseconds;

constexpr double kDecided = 20;    // difference of costs: odds of 20,000 to 1
constexpr double kOnePose = 0.01;  // rad; nearer than that two heads are one
constexpr double kSurprised = 38;  // χ² with 6 degrees of freedom: one in a million
constexpr int kLeastCorners = 3;

double turnOf(const HeadMotion& a, const HeadMotion& b) {
  return rotationLog(a.T_world_head.linear().transpose() * b.T_world_head.linear()).norm();
}

std::set<int> tagsOf(const std::vector<HeadSight>& sights, const std::vector<bool>* used) {
  std::set<int> ids;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    if (!used || (*used)[i]) ids.insert(sights[i].tag);
  }
  return ids;
}

/// Squares of which no corner is used, by tag.
std::vector<int> leftOut(const std::vector<HeadSight>& sights, const std::vector<bool>& used) {
  std::set<int> ids;
  for (std::size_t i = 0; i + 3 < sights.size(); i += 4) {
    if (!used[i] && !used[i + 1] && !used[i + 2] && !used[i + 3]) ids.insert(sights[i].tag);
  }
  return {ids.begin(), ids.end()};
}

}  // namespace

struct HeadStep::Update {
  nanoseconds time;
  std::vector<EyeSight> pictures;
  std::vector<HeadSight> sights;
  std::vector<HeadHypothesis> before;  // predicted to the time
  struct Candidate {
    HeadFit fit;
    double score;
  };
  std::vector<Candidate> found;
  bool relocked = false;
};

bool HeadStep::plausible(const Isometry3d& T_world_head) const {
  if (options_.most_roll <= 0) return true;
  const Isometry3d T_world_left = T_world_head * eyes_[0].T_head_camera;
  const auto right = T_world_left.linear().col(0), down = T_world_left.linear().col(1);
  return T_world_left.translation().z() > 0 &&
         std::abs(right.z()) < std::sin(std::min(options_.most_roll, 1.57)) && down.z() < 0.5;
}

std::vector<HeadHypothesis> HeadStep::predictedHeads(const HeadMoment* before,
                                                     nanoseconds time) const {
  std::vector<HeadHypothesis> heads;
  if (!before || time - before->last_seen > options_.coast_limit) return heads;
  for (const HeadHypothesis& head : before->heads) {
    heads.push_back({predicted(head.motion, time, options_.noise), head.score});
  }
  return heads;
}

/// Each head by the corners and its prediction.
void HeadStep::update(Update& update) const {
  for (const HeadHypothesis& head : update.before) {
    HeadFitProblem problem{eyes_, update.sights, head.motion, true, options_.gate_sigmas};
    auto fit = fitHeadWarily(problem, head.motion);
    if (!fit || fit->used_count < kLeastCorners) continue;
    update.found.push_back({std::move(*fit), 0});
    update.found.back().score = head.score + update.found.back().fit.cost;
  }
}

/// Where the corners contradict the prediction or each other, the head is looked for anew; it is
/// there where more corners fit than before.
void HeadStep::doubt(Update& update) const {
  if (update.found.empty()) return start(update);
  if (update.found.size() > 1) return;
  const HeadFit& fit = update.found[0].fit;
  const auto seen = static_cast<int>(update.sights.size());
  const bool few = 2 * fit.used_count < seen;
  if (!few && fit.surprise < kSurprised) return;
  Update anew{update.time, update.pictures, update.sights, {}, {}, false};
  start(anew);
  if (anew.found.size() != 1) return;
  const HeadFit& other = anew.found[0].fit;
  const bool better = other.used_count > fit.used_count ||
                      (other.used_count == fit.used_count && fit.surprise >= kSurprised);
  if (better && tagsOf(update.sights, &other.used).size() > 1) {
    update.found = std::move(anew.found);
    update.relocked = true;
  }
}

/// A lone tag has a second pose that fits nearly as well: carried on unless prediction or the other
/// eye rule it out.
void HeadStep::considerOthers(Update& update) const {
  if (update.found.size() != 1 || update.before.empty() || update.relocked) return;
  const HeadFit main = update.found[0].fit;
  if (tagsOf(update.sights, &main.used).size() > 1) return;
  const HeadHypothesis& head = update.before[0];
  for (const Isometry3d& pose : otherPoses(eyes_, layout_, update.pictures, main.motion)) {
    HeadMotion from = head.motion;
    from.T_world_head = pose;
    HeadFitProblem problem{eyes_, update.sights, head.motion, true, options_.gate_sigmas};
    auto fit = fitHead(problem, from);
    if (!fit || fit->used_count < kLeastCorners || turnOf(fit->motion, main.motion) < kOnePose ||
        fit->cost > main.cost + kDecided || !plausible(fit->motion.T_world_head)) {
      continue;
    }
    update.found.push_back({std::move(*fit), 0});
    update.found.back().score = head.score + update.found.back().fit.cost;
    return;
  }
}

void HeadStep::start(Update& update) const {
  HeadStartOptions options;
  options.time = update.time;
  options.gate_sigmas = options_.gate_sigmas;
  options.plausible = [this](const Isometry3d& T) { return plausible(T); };
  for (HeadFit& fit : findHead(eyes_, layout_, update.pictures, update.sights, options)) {
    update.found.push_back({std::move(fit), 0});
    update.found.back().score = update.found.back().fit.cost;
  }
  update.relocked = !update.found.empty();
}

/// Best first; one that is decided against, or is the same as the best, goes.
void HeadStep::conclude(Update& update, HeadMoment& moment) const {
  auto& found = update.found;
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.score < b.score; });
  if (found.size() > 1 && (found[1].score - found[0].score > kDecided ||
                           turnOf(found[0].fit.motion, found[1].fit.motion) < kOnePose)) {
    found.resize(1);
  }
  moment.heads.clear();
  for (const auto& one : found) {
    moment.heads.push_back({one.fit.motion, one.score - found[0].score});
  }
  HeadFix& fix = moment.fix;
  fix.tags_seen = static_cast<int>(tagsOf(update.sights, nullptr).size());
  if (found.empty()) {
    moment.heads = update.before;
    fix.state = moment.heads.empty() ? HeadState::searching : HeadState::coasting;
    return;
  }
  const HeadFit& best = found[0].fit;
  fix.state = found.size() > 1 ? HeadState::ambiguous : HeadState::tracking;
  fix.tags_used = static_cast<int>(tagsOf(update.sights, &best.used).size());
  fix.corners_used = best.used_count;
  fix.residual_px = best.residual_px;
  fix.rejected_ids = leftOut(update.sights, best.used);
  fix.relocked = update.relocked;
  if (!update.relocked) fix.surprise = best.surprise;
  moment.last_seen = moment.time;
  moment.fit = best;
}

void HeadStep::evaluate(const HeadMoment* before, HeadMoment& moment) const {
  Update update{moment.time, {}, {}, predictedHeads(before, moment.time), {}, false};
  nanoseconds latest = moment.time;
  for (const HeadPicture& picture : moment.pictures) {
    const std::chrono::duration<double> delay = picture.time - moment.time;
    update.pictures.push_back({picture.camera, delay.count(), picture.tags});
    latest = std::max(latest, picture.time);
  }
  update.sights = sightsOf(eyes_, layout_, update.pictures, options_.corner_bias_px);
  moment.last_seen = before ? before->last_seen : nanoseconds::min() / 2;
  moment.fix = {};
  moment.fix.time = latest;
  moment.fit.reset();
  if (!update.sights.empty()) {
    this->update(update);
    doubt(update);
    considerOthers(update);
  }
  conclude(update, moment);
  moment.sights = std::move(update.sights);
}

}  // namespace slamscope::tracking
