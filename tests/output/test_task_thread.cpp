// A thread that does tasks in order: it works beside its owner, holds no more than its capacity, and loses neither task
// nor error.

#include <algorithm>
#include <atomic>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_exception.hpp>
#include <chrono>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "output/task_thread.hpp"

using Catch::Matchers::Message;
using railwave::TaskThread;

namespace {

/// Waits until `true_at_last` is, and says whether it ever was: a test that goes wrong must end.
template <class Condition>
bool comes_true(const Condition& true_at_last) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!true_at_last()) {
    if (std::chrono::steady_clock::now() > give_up) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return true;
}

void dawdle() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

/// Says how many of it there are, and how many there were at most.
struct Counted {
  static std::atomic<int> alive, most;
  Counted() { most = std::max(most.load(), ++alive); }
  ~Counted() { --alive; }
};
std::atomic<int> Counted::alive{0}, Counted::most{0};

}  // namespace

TEST_CASE("tasks are done in the order they were added, and finish() waits for all") {
  std::vector<int> done;
  TaskThread thread(7);
  for (int i = 0; i < 500; ++i)
    thread.add([&done, i] {
      if (i % 100 == 99) dawdle();
      done.push_back(i);
    });
  thread.finish();
  std::vector<int> expected(500);
  std::iota(expected.begin(), expected.end(), 0);
  CHECK(done == expected);
  thread.add([&] { done.clear(); });
  thread.finish();
  CHECK(done.empty());
}

TEST_CASE("the owner goes on while a task is done") {
  std::atomic<bool> owner_went_on{false}, seen{false};
  TaskThread thread(1);
  thread.add([&] { seen = comes_true([&] { return owner_went_on.load(); }); });
  owner_went_on = true;
  thread.finish();
  CHECK(seen);
}

TEST_CASE("no more is kept than the capacity allows, and what a task held is gone when its share of it is given away") {
  Counted::most = 0;
  constexpr int capacity = 3;
  std::atomic<int> added{0}, done{0}, most_at_once{0};
  std::atomic<bool> filled{false};
  {
    TaskThread thread(2 * capacity);
    for (int i = 0; i < 60; ++i) {
      thread.add(
          [&, i, held = std::make_shared<Counted>()] {
            // The first waits until the capacity is full, so that it is seen full.
            if (i == 0) filled = comes_true([&] { return added == capacity; });
            dawdle();
            most_at_once = std::max(most_at_once.load(), added - done);
            ++done;
          },
          2);
      ++added;
    }
  }
  CHECK(filled);
  CHECK(done == 60);
  CHECK(most_at_once == capacity);
  CHECK(Counted::most <= capacity + 1);  // and the one that its owner wants to add
  CHECK(Counted::alive == 0);
}

TEST_CASE("a task larger than the capacity is done all the same") {
  int done = 0;
  TaskThread thread(2);
  for (int i = 0; i < 5; ++i) thread.add([&] { ++done; }, 10);
  thread.finish();
  CHECK(done == 5);
}

TEST_CASE("a task's exception comes to the owner, every time it asks, and nothing is done after it") {
  int done = 0;
  TaskThread thread(10);
  std::atomic<bool> all_added{false};
  thread.add([&] {
    comes_true([&] { return all_added.load(); });
    throw std::out_of_range("the disk is full");
  });
  for (int i = 0; i < 5; ++i) thread.add([&] { ++done; });
  all_added = true;
  CHECK_THROWS_MATCHES(thread.finish(), std::out_of_range, Message("the disk is full"));
  CHECK_THROWS_MATCHES(thread.add([&] { ++done; }), std::out_of_range, Message("the disk is full"));
  CHECK_THROWS_AS(thread.finish(), std::out_of_range);
  CHECK(done == 0);
}

TEST_CASE("an owner that waits for capacity gets the exception") {
  TaskThread thread(1);
  std::atomic<bool> added{false};
  thread.add([&] {
    comes_true([&] { return added.load(); });
    dawdle();
    throw std::runtime_error("the disk is full");
  });
  added = true;
  CHECK_THROWS_MATCHES(thread.add([] {}), std::runtime_error, Message("the disk is full"));
}

TEST_CASE("the destructor does what waits, and throws nothing") {
  std::atomic<int> done{0};
  {
    TaskThread thread(20);
    for (int i = 0; i < 10; ++i)
      thread.add([&] {
        dawdle();
        ++done;
      });
  }
  CHECK(done == 10);
  const auto owner_fails = [&] {
    TaskThread thread(20);
    thread.add([&] { ++done; });
    thread.add([] { throw std::runtime_error("the disk is full"); });
    throw std::logic_error("the owner's own");
  };
  CHECK_THROWS_MATCHES(owner_fails(), std::logic_error, Message("the owner's own"));
  CHECK(done == 11);
  { const TaskThread idle(1); }
}

TEST_CASE("a thread knows whether its owner waits for it") {
  std::atomic<bool> asked{false};
  bool before = true, at_last = false;
  TaskThread thread(1);
  thread.add([&] {
    before = thread.is_awaited();
    asked = true;
    at_last = comes_true([&] { return thread.is_awaited(); });
  });
  REQUIRE(comes_true([&] { return asked.load(); }));
  SECTION("for all") { thread.finish(); }
  SECTION("for its capacity") {
    thread.add([] {});
  }
  thread.finish();
  CHECK_FALSE(before);
  CHECK(at_last);
  CHECK_FALSE(thread.is_awaited());
}
