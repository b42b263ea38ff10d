// SPDX-License-Identifier: MIT
#include "slam/subject.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace slamscope::slam {
namespace {

class Source : public Subject {
 public:
  void send(Event event) {
    auto snapshot = std::make_shared<Snapshot>();
    snapshot->event = event;
    publish(snapshot);
  }
};

TEST(Subject, TellsOnlyThoseWhoAskedForTheEvent) {
  Source source;
  int updates = 0;
  int all = 0;
  const Subscription one = source.observe({Event::update}, [&](const SnapshotPtr&) { ++updates; });
  const Subscription two = source.observe([&](const SnapshotPtr&) { ++all; });
  source.send(Event::predict);
  source.send(Event::update);
  EXPECT_EQ(updates, 1);
  EXPECT_EQ(all, 2);
}

TEST(Subject, WantsWhatSomebodySubscribedTo) {
  Source source;
  EXPECT_FALSE(source.wants(Event::step));
  {
    const Subscription subscription =
        source.observe({Event::step, Event::initial}, [](const SnapshotPtr&) {});
    EXPECT_TRUE(source.wants(Event::step));
    EXPECT_TRUE(source.wants(Event::initial));
    EXPECT_FALSE(source.wants(Event::update));
  }
  EXPECT_FALSE(source.wants(Event::step));
}

TEST(Subject, CallsInTheOrderOfSubscription) {
  Source source;
  std::vector<int> order;
  std::vector<Subscription> subscriptions;
  for (int k = 0; k < 4; ++k) {
    subscriptions.push_back(
        source.observe([&order, k](const SnapshotPtr&) { order.push_back(k); }));
  }
  source.send(Event::step);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Subject, DroppingASubscriptionDetaches) {
  Source source;
  int calls = 0;
  Subscription subscription = source.observe([&](const SnapshotPtr&) { ++calls; });
  source.send(Event::step);
  subscription = Subscription();
  source.send(Event::step);
  EXPECT_EQ(calls, 1);
}

TEST(Subject, AnObserverMayDropItselfAndOthersWhileCalled) {
  Source source;
  int first = 0;
  int second = 0;
  Subscription one;
  Subscription two;
  one = source.observe([&](const SnapshotPtr&) {
    ++first;
    two = Subscription();
    one = Subscription();
  });
  two = source.observe([&](const SnapshotPtr&) { ++second; });
  source.send(Event::step);
  source.send(Event::step);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 0);
}

TEST(Subject, ASubscriptionMayOutliveItsSubject) {
  Subscription subscription;
  {
    Source source;
    subscription = source.observe([](const SnapshotPtr&) {});
  }
  subscription = Subscription();
}

TEST(Subject, SubscribingWhileCalledStartsWithTheNextSnapshot) {
  Source source;
  int calls = 0;
  int late = 0;
  Subscription inner;
  const Subscription outer = source.observe([&](const SnapshotPtr&) {
    if (++calls == 1) inner = source.observe([&](const SnapshotPtr&) { ++late; });
  });
  source.send(Event::step);
  EXPECT_EQ(late, 0);
  source.send(Event::step);
  EXPECT_EQ(late, 1);
}

}  // namespace
}  // namespace slamscope::slam
