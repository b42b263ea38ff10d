// SPDX-License-Identifier: MIT
#include "tracking/head_history.hpp"

#include <algorithm>

namespace slamscope::tracking {
namespace {

using std::chrono::nanoseconds;

bool earlier(nanoseconds time, const HeadMoment& moment) {
  return time < moment.time;
}

}  // namespace

std::size_t HeadHistory::put(HeadPicture picture, nanoseconds together) {
  for (std::size_t i = moments_.size(); i-- > 0;) {
    HeadMoment& moment = moments_[i];
    if (moment.time < picture.time - together) break;
    if (moment.time > picture.time + together) continue;
    const bool has_one = std::any_of(moment.pictures.begin(), moment.pictures.end(),
                                     [&](const auto& p) { return p.camera == picture.camera; });
    if (has_one) continue;
    moment.pictures.push_back(std::move(picture));
    return i;
  }
  const auto place = std::upper_bound(moments_.begin(), moments_.end(), picture.time, earlier);
  HeadMoment moment;
  moment.time = picture.time;
  moment.pictures.push_back(std::move(picture));
  const auto index = static_cast<std::size_t>(place - moments_.begin());
  moments_.insert(place, std::move(moment));
  return index;
}

void HeadHistory::forget() {
  while (moments_.size() > 1 && moments_.front().time < moments_.back().time - length_) {
    moments_.pop_front();
  }
}

nanoseconds HeadHistory::begins() const {
  return moments_.empty() ? nanoseconds::min() : moments_.back().time - length_;
}

bool HeadHistory::has(std::size_t camera, nanoseconds time) const {
  for (const HeadMoment& moment : moments_) {
    for (const HeadPicture& picture : moment.pictures) {
      if (picture.camera == camera && picture.time == time) return true;
    }
  }
  return false;
}

const HeadMoment* HeadHistory::before(nanoseconds time) const {
  const auto after = std::upper_bound(moments_.begin(), moments_.end(), time, earlier);
  return after == moments_.begin() ? nullptr : &*std::prev(after);
}

const HeadMoment* HeadHistory::find(nanoseconds time) const {
  const auto at = std::find_if(moments_.begin(), moments_.end(),
                               [&](const HeadMoment& moment) { return moment.time == time; });
  return at == moments_.end() ? nullptr : &*at;
}

}  // namespace slamscope::tracking
