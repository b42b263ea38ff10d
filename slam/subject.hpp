// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>

#include "slam/snapshot.hpp"

namespace slamscope::slam {

/// Set of event kinds an observer asks for.
class EventSet {
 public:
  constexpr EventSet() = default;
  constexpr EventSet(std::initializer_list<Event> events) {
    for (const Event event : events) bits_ |= bit(event);
  }
  [[nodiscard]] static constexpr EventSet all() { return EventSet{0x3fU}; }
  [[nodiscard]] constexpr bool contains(Event event) const { return (bits_ & bit(event)) != 0; }
  [[nodiscard]] constexpr EventSet operator|(EventSet other) const {
    return EventSet{bits_ | other.bits_};
  }

 private:
  constexpr explicit EventSet(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Event event) {
    return 1U << static_cast<std::uint32_t>(event);
  }
  std::uint32_t bits_ = 0;
};

/// Keeps an observer attached; dropping it detaches. May outlive the subject. Move only.
class Subscription {
 public:
  Subscription() = default;
  explicit Subscription(std::shared_ptr<void> ticket) : ticket_(std::move(ticket)) {}
  Subscription(Subscription&&) noexcept = default;
  Subscription& operator=(Subscription&&) noexcept = default;

 private:
  std::shared_ptr<void> ticket_;
};

/// The paper's Observer pattern (section 3.1): every source of snapshots – filter, replay, live
/// link – is a Subject; viewer, recorder, scorer and audit observe. Observers are called on the
/// publishing thread, in the order in which they subscribed. Not thread-safe: subscribe, publish
/// and drop subscriptions on one thread (an observer may drop subscriptions while it is being
/// called).
class Subject {
 public:
  using Callback = std::function<void(const SnapshotPtr&)>;

  Subject();
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;
  ~Subject();

  [[nodiscard]] Subscription observe(EventSet events, Callback callback);
  [[nodiscard]] Subscription observe(Callback callback) {
    return observe(EventSet::all(), std::move(callback));
  }
  /// Whether somebody subscribed to this kind: a source builds a snapshot only then.
  [[nodiscard]] bool wants(Event event) const;

 protected:
  void publish(const SnapshotPtr& snapshot) const;

 private:
  struct Observers;
  std::shared_ptr<Observers> observers_;
};

}  // namespace slamscope::slam
