// SPDX-License-Identifier: MIT
#include "tracking/picture_order.hpp"

#include <algorithm>

namespace slamscope::tracking {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kComplaintLasts{2'000'000'000};

std::string inMilliseconds(nanoseconds time) {
  return std::to_string((time.count() + 500'000) / 1'000'000) + " ms";
}

}  // namespace

bool PictureOrder::accepts(const HeadPicture& picture, const HeadHistory& history) {
  const std::string camera = two_ ? (picture.camera == 0 ? "left camera: " : "right camera: ") : "";
  nanoseconds& last = last_[picture.camera];
  newest_ = std::max(newest_, picture.time);
  if (history.has(picture.camera, picture.time)) {
    complain(camera + "a frame came twice");
    return false;
  }
  if (picture.time < history.begins()) {
    complain(camera + "a frame came too late to count");
    return false;
  }
  if (last != nanoseconds::min() && picture.time < last) {
    complain(camera + "frames come out of order");
  } else if (last != nanoseconds::min()) {
    const nanoseconds since = picture.time - last;
    interval_ = interval_.count() == 0 ? since : std::min(interval_ * 11 / 10, since);
  }
  last = std::max(last, picture.time);
  return true;
}

void PictureOrder::compare(const std::vector<HeadPicture>& pair) {
  if (pair.size() != 2 || pair[0].camera == pair[1].camera || interval_.count() == 0) return;
  const nanoseconds apart =
      std::max(pair[0].time, pair[1].time) - std::min(pair[0].time, pair[1].time);
  if (2 * apart <= interval_ + nanoseconds(1'000'000)) return;
  std::erase_if(complaints_, [](const auto& one) { return one.first.starts_with("eyes are"); });
  complain("eyes are " + inMilliseconds(apart) + " apart, more than half a frame");
}

void PictureOrder::complain(const std::string& what) {
  complaints_[what] = newest_;
}

std::vector<std::string> PictureOrder::problems() const {
  std::vector<std::string> result;
  for (const auto& [what, when] : complaints_) {
    if (newest_ - when < kComplaintLasts) result.push_back(what);
  }
  return result;
}

}  // namespace slamscope::tracking
