// SPDX-License-Identifier: MIT
#include "tracking/head_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <stdexcept>

#include "tracking/head_history.hpp"
#include "tracking/head_step.hpp"
#include "tracking/picture_order.hpp"
#include "tracking/stated_check.hpp"
#include "tracking/tag_faults.hpp"

namespace slamscope::tracking {
namespace {

using std::chrono::nanoseconds;

constexpr std::array<const char*, 2> kEyeNames{"the left camera", "the right camera"};
constexpr nanoseconds kFreshPose{100'000'000};  // tracked until then, coasting after it
constexpr nanoseconds kTogether{2'000'000};     // exposed together: fitted together
constexpr double kFits_px = 1.5;  // a worse residual is no ground to find fault with single tags

void checkRig(const Rig& rig, const TagLayout& layout) {
  if (rig.cameras.empty() || rig.cameras.size() > 2) {
    throw std::invalid_argument("head tracker: a rig of one camera or two is expected, not " +
                                std::to_string(rig.cameras.size()));
  }
  if (layout.tags.empty()) throw std::invalid_argument("head tracker: the layout has no tag");
}

double root(double square) {
  return std::sqrt(std::max(0.0, square));
}

}  // namespace

const char* name(HeadState state) {
  switch (state) {
    case HeadState::searching:
      return "searching";
    case HeadState::ambiguous:
      return "ambiguous";
    case HeadState::tracking:
      return "tracking";
    case HeadState::coasting:
      return "coasting";
  }
  return "";
}

struct HeadTracker::Parts {
  Parts(Rig given_rig, TagLayout given_layout, const HeadTrackerOptions& options)
      : rig(std::move(given_rig)),
        layout(std::move(given_layout)),
        history(options.history),
        order(rig) {
    checkRig(rig, layout);
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
      eyes.emplace_back(rig, i);
      stated.emplace_back(rig.cameras.size() == 1 ? "the camera" : kEyeNames[i]);
    }
    step.emplace(eyes, layout, options);
  }

  /// Puts the pictures in their place, those exposed together in one, and goes on from the first.
  void take(std::vector<HeadPicture> pictures) {
    std::stable_sort(pictures.begin(), pictures.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    for (HeadPicture& picture : pictures) {
      const nanoseconds time = picture.time;
      const std::size_t first = history.put(std::move(picture), kTogether);
      for (std::size_t i = first; i < history.moments().size(); ++i) {
        step->evaluate(i > 0 ? &history.moments()[i - 1] : nullptr, history.moments()[i]);
      }
      newest = std::max(newest, time);
      last_moment = history.moments()[first].time;
    }
    history.forget();
    if (const HeadMoment* moment = history.find(last_moment)) {
      last = moment->fix;
      learn(*moment);
    }
  }

  /// What the moment says about what was stated.
  void learn(const HeadMoment& moment) {
    if (!moment.fit || moment.heads.size() != 1) return;
    std::set<int> used;
    for (std::size_t i = 0; i < moment.sights.size(); ++i) {
      if (moment.fit->used[i]) used.insert(moment.sights[i].tag);
    }
    if (used.size() >= 2 && moment.fit->residual_px < kFits_px) {
      faults.add(eyes, layout, moment.sights, *moment.fit);
    }
    for (std::size_t i = 0; i < eyes.size(); ++i) {
      stated[i].add(eyes[i], layout, moment.sights, moment.fit->motion, i);
    }
  }

  Rig rig;
  TagLayout layout;
  std::vector<EyeCamera> eyes;
  std::optional<HeadStep> step;
  HeadHistory history;
  PictureOrder order;
  TagFaults faults;
  std::vector<StatedCheck> stated;
  HeadFix last;
  nanoseconds newest{nanoseconds::min()}, last_moment{};
};

HeadTracker::HeadTracker(Rig rig, TagLayout layout, HeadTrackerOptions options)
    : parts_(std::make_unique<Parts>(std::move(rig), std::move(layout), options)) {}
HeadTracker::~HeadTracker() = default;
HeadTracker::HeadTracker(HeadTracker&&) noexcept = default;
HeadTracker& HeadTracker::operator=(HeadTracker&&) noexcept = default;

void HeadTracker::add(std::span<const HeadPicture> pictures) {
  std::vector<HeadPicture> taken;
  for (const HeadPicture& picture : pictures) {
    if (picture.camera >= parts_->eyes.size()) {
      throw std::out_of_range("head tracker: the rig has no camera " +
                              std::to_string(picture.camera));
    }
    HeadPicture timed = picture;
    timed.time += parts_->rig.cameras[picture.camera].time_offset;
    if (parts_->order.accepts(timed, parts_->history)) taken.push_back(std::move(timed));
  }
  parts_->order.compare(taken);
  if (!taken.empty()) parts_->take(std::move(taken));
}

std::optional<HeadPose> HeadTracker::at(nanoseconds time) const {
  const HeadMoment* moment = parts_->history.before(time + kTogether);
  if (!moment || moment->heads.empty()) return std::nullopt;
  const nanoseconds age = time - moment->last_seen;
  if (age > parts_->step->options().coast_limit) return std::nullopt;
  HeadPose pose;
  pose.motion = predicted(moment->heads[0].motion, time, parts_->step->options().noise);
  pose.age = age;
  if (moment->heads.size() > 1) {
    pose.state = HeadState::ambiguous;
    pose.other_T_world_head =
        predicted(moment->heads[1].motion, time, parts_->step->options().noise).T_world_head;
  } else {
    const bool fresh = moment->fix.state == HeadState::tracking && age <= kFreshPose;
    pose.state = fresh ? HeadState::tracking : HeadState::coasting;
  }
  return pose;
}

HeadState HeadTracker::state(nanoseconds time) const {
  const auto pose = at(time);
  return pose ? pose->state : HeadState::searching;
}

const HeadFix& HeadTracker::last() const {
  return parts_->last;
}

std::vector<std::string> HeadTracker::problems() const {
  std::vector<std::string> all = parts_->faults.named();
  for (const StatedCheck& check : parts_->stated) {
    const auto problem = check.named();
    if (problem && std::find(all.begin(), all.end(), *problem) == all.end()) {
      all.push_back(*problem);
    }
  }
  for (std::string& problem : parts_->order.problems()) all.push_back(std::move(problem));
  return all;
}

std::string HeadTracker::status(nanoseconds time) const {
  const auto pose = at(time);
  std::string text = name(pose ? pose->state : HeadState::searching);
  const HeadFix& fix = parts_->last;
  std::array<char, 160> numbers{};
  if (!pose) return text + ": no tag of the layout in view";
  const Matrix18d& P = pose->motion.covariance;
  std::snprintf(numbers.data(), numbers.size(),
                ": %d of %d tags, residual %.2f px, head ±%.1f mm ±%.2f°", fix.tags_used,
                fix.tags_seen, fix.residual_px, 1e3 * root(P.topLeftCorner<3, 3>().trace() / 3),
                180 / std::numbers::pi * root(P.block<3, 3>(3, 3).trace() / 3));
  return text + numbers.data();
}

const Rig& HeadTracker::rig() const {
  return parts_->rig;
}

const TagLayout& HeadTracker::layout() const {
  return parts_->layout;
}

}  // namespace slamscope::tracking
