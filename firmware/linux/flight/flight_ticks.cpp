#include "firmware/linux/flight/flight_ticks.h"

#include <cstring>
#include <tuple>

namespace tactus::firmware {

bool FlightTicks::add(const RecordedTick& tick) {
  const std::uint64_t number = tick.record.tick;
  const bool begins = begins_ || number != end_tick_.load(std::memory_order_relaxed);
  if (begins) {
    begins_ = false;
    begin_tick_.store(number, std::memory_order_release);
  }
  put(ticks_[number % kFlightTicks], tick);
  end_tick_.store(number + 1, std::memory_order_release);
  return begins;
}

// Writes a tick into its slot. The release order makes sure that a reader who sees a word of a
// later tick also sees a later end_tick_.
void FlightTicks::put(Slot& slot, const RecordedTick& tick) {
  std::array<std::uint64_t, std::tuple_size_v<Slot>> words{};
  std::memcpy(words.data(), &tick, sizeof tick);
  for (std::size_t i = 0; i < words.size(); ++i) {
    slot[i].store(words[i], std::memory_order_release);
  }
}

void FlightTicks::take(const Slot& slot, RecordedTick& to) {
  std::array<std::uint64_t, std::tuple_size_v<Slot>> words{};
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = slot[i].load(std::memory_order_acquire);
  }
  std::memcpy(static_cast<void*>(&to), words.data(), sizeof to);
}

bool FlightTicks::read(std::uint64_t number, RecordedTick& to) const {
  const auto is_there = [&] {
    // The oldest tick is excluded, because the loop may be overwriting it.
    return number < end_tick() && end_tick() - number < kFlightTicks && number >= begin_tick();
  };
  if (!is_there()) {
    return false;
  }
  take(ticks_[number % kFlightTicks], to);
  // The loop may have overwritten the tick during the copy, so the place is checked again.
  return is_there();
}

}  // namespace tactus::firmware
