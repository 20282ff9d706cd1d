#include "firmware/telemetry/ring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>

namespace tactus::firmware {
namespace {

struct Counted {
  std::uint64_t number = 0;
  std::array<std::uint64_t, 8> copies{};  // all the number: a torn item would differ
};

Counted counted(std::uint64_t number) {
  Counted item{.number = number};
  item.copies.fill(number);
  return item;
}

// The oldest item, or -1.
template <std::size_t kCapacity>
int take(Ring<int, kCapacity>& ring) {
  const int* item = ring.front();
  if (item == nullptr) {
    return -1;
  }
  const int taken = *item;
  ring.pop();
  return taken;
}

TEST(Ring, GivesItemsInOrder) {
  Ring<int, 4> ring;
  EXPECT_EQ(ring.front(), nullptr);
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(ring.push(3 * round + i));
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(take(ring), 3 * round + i);
    }
    EXPECT_EQ(ring.front(), nullptr);
  }
  EXPECT_EQ(ring.dropped(), 0U);
}

TEST(Ring, DropsTheNewestWhenFullAndCountsIt) {
  Ring<int, 4> ring;
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(ring.push(i));
  }
  EXPECT_FALSE(ring.push(4));
  EXPECT_FALSE(ring.push(5));
  EXPECT_EQ(ring.dropped(), 2U);
  EXPECT_EQ(take(ring), 0);
  EXPECT_TRUE(ring.push(6));
  for (const int expected : {1, 2, 3, 6}) {
    EXPECT_EQ(take(ring), expected);
  }
  EXPECT_EQ(ring.front(), nullptr);
}

TEST(Ring, BetweenTwoThreadsEveryItemArrivesWholeOrIsCountedAsDropped) {
  constexpr std::uint64_t kItems = 200'000;
  const auto ring = std::make_unique<Ring<Counted, 64>>();
  std::jthread producer([&] {
    for (std::uint64_t i = 0; i < kItems; ++i) {
      ring->push(counted(i));
    }
    while (!ring->push(counted(kItems))) {
      std::this_thread::yield();  // the last one arrives: it ends the test
    }
  });
  std::uint64_t received = 0;
  std::uint64_t next = 0;
  bool whole = true;
  bool in_order = true;
  for (bool open = true; open;) {
    const Counted* item = ring->front();
    if (item == nullptr) {
      std::this_thread::yield();
      continue;
    }
    for (const std::uint64_t copy : item->copies) {
      whole = whole && copy == item->number;
    }
    in_order = in_order && item->number >= next;
    next = item->number + 1;
    open = item->number != kItems;
    ++received;
    ring->pop();
  }
  producer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(in_order);
  // Tries to push the last item that found no room are drops too.
  EXPECT_GE(received + ring->dropped(), kItems + 1);
}

TEST(Ring, CountsDropsExactlyBetweenTwoThreads) {
  constexpr std::uint64_t kItems = 200'000;
  const auto ring = std::make_unique<Ring<Counted, 64>>();
  std::atomic<bool> done = false;
  std::uint64_t received = 0;
  std::jthread consumer([&] {
    for (;;) {
      const bool last_look = done.load(std::memory_order_acquire);
      if (ring->front() != nullptr) {
        ring->pop();
        ++received;
      } else if (last_look) {
        return;
      }
    }
  });
  for (std::uint64_t i = 0; i < kItems; ++i) {
    ring->push(counted(i));
  }
  done.store(true, std::memory_order_release);
  consumer.join();
  EXPECT_EQ(received + ring->dropped(), kItems);
}

}  // namespace
}  // namespace tactus::firmware
