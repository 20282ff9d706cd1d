// A ring buffer that carries fixed-size items from one thread to one other, without locks.
//
// The producer is the real-time loop: `push` is wait-free and copies the item. An item that finds
// the ring full is dropped and counted. The consumer takes the items in order.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/object_places.h"
#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::firmware {

// A ring of kCapacity items. Each side works on its own copy of the other's count and looks at the
// true one only if the ring seems full or empty, so that the cache line is seldom shared.
template <class Item, std::size_t kCapacity>
class Ring {
  static_assert(std::is_trivially_copyable_v<Item>);
  static_assert(std::has_single_bit(kCapacity), "a power of two, so that the counts may wrap");

 public:
  // Adds an item. Returns false, and counts the item as dropped, if the ring is full. Producer
  // only.
  bool push(const Item& item) {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - seen_begin_ == kCapacity) {
      seen_begin_ = begin_.load(std::memory_order_acquire);
      if (end - seen_begin_ == kCapacity) {
        dropped_.store(dropped_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
        return false;
      }
    }
    items_[end % kCapacity] = item;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  // Returns the oldest item, or null if there is none. It is valid until `pop`. Consumer only.
  const Item* front() {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == seen_end_) {
      seen_end_ = end_.load(std::memory_order_acquire);
      if (begin == seen_end_) {
        return nullptr;
      }
    }
    return &items_[begin % kCapacity];
  }

  // Removes the item of `front`, which must not have been null. Consumer only.
  void pop() {
    begin_.store(begin_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

  // Returns the number of items dropped since the start, which a machine of 32 bits counts to 2^32.
  // Any thread.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  // The variables of the two threads are in separate cache lines.
  static constexpr std::size_t kCacheLine = 64;

  alignas(kCacheLine) std::atomic<std::size_t> end_{0};
  // The producer's last look at begin_.
  std::size_t seen_begin_ = 0;
  std::atomic<std::size_t> dropped_{0};
  alignas(kCacheLine) std::atomic<std::size_t> begin_{0};
  // The consumer's last look at end_.
  std::size_t seen_end_ = 0;
  alignas(kCacheLine) std::array<Item, kCapacity> items_{};

  static_assert(std::atomic<std::size_t>::is_always_lock_free);
};

// The ring of ticks: 4 s at 1 kHz, half a second at 8 kHz, because a disk stalls for less.
using RecordRing = Ring<RecordedTick, 4096>;
// The ring of events, which are as rare as requests.
using EventRing = Ring<TelemetryEvent, 256>;
// The ring of explanations, which a disk may delay but not a reader.
using ExplanationRing = Ring<Explanation, 1024>;
// The ring of places, of which displays miss a few without harm.
using PlacesRing = Ring<ObjectPlaces, 16>;

}  // namespace tactus::firmware
