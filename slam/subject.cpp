// SPDX-License-Identifier: MIT
#include "slam/subject.hpp"

#include <algorithm>
#include <vector>

namespace slamscope::slam {

struct Subject::Observers {
  struct Entry {
    EventSet events;
    Callback callback;
  };
  std::vector<std::weak_ptr<Entry>> entries;
};

Subject::Subject() : observers_(std::make_shared<Observers>()) {}
Subject::~Subject() = default;

Subscription Subject::observe(EventSet events, Callback callback) {
  auto entry = std::make_shared<Observers::Entry>(Observers::Entry{events, std::move(callback)});
  std::erase_if(observers_->entries, [](const auto& known) { return known.expired(); });
  observers_->entries.push_back(entry);
  return Subscription(std::move(entry));
}

bool Subject::wants(Event event) const {
  return std::any_of(observers_->entries.begin(), observers_->entries.end(),
                     [event](const std::weak_ptr<Observers::Entry>& known) {
                       const auto entry = known.lock();
                       return entry && entry->events.contains(event);
                     });
}

void Subject::publish(const SnapshotPtr& snapshot) const {
  const auto entries = observers_->entries;  // an observer may subscribe or drop while called
  for (const auto& known : entries) {
    if (const auto entry = known.lock(); entry && entry->events.contains(snapshot->event)) {
      entry->callback(snapshot);
    }
  }
}

}  // namespace slamscope::slam
