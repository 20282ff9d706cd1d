#include "firmware/linux/flight/flight_recorder.h"

namespace tactus::firmware {

void FlightRecorder::use_room(std::span<std::byte> room) {
  const std::size_t bytes = room.size() / kStates;
  for (std::size_t i = 0; i < kStates; ++i) {
    states_[i].bytes = room.subspan(i * bytes, bytes);
  }
}

void FlightRecorder::add(const RecordedTick& tick, Controller& controller) {
  const std::uint64_t number = tick.record.tick;
  if (ticks_.add(tick)) {
    begin(number);
  }
  if (number + 1 >= state_due_) {
    take_state(number + 1, controller);
  }
}

void FlightRecorder::begin(std::uint64_t tick) {
  for (State& state : states_) {
    state.first_tick.store(kNoTick, std::memory_order_relaxed);
  }
  state_due_ = tick + 1;
}

void FlightRecorder::take_state(std::uint64_t next_tick, Controller& controller) {
  // This is the time of the next attempt if the state cannot be taken now.
  state_due_ = next_tick + kTicksToRetry;
  State* const state = oldest_free();
  if (state == nullptr) {
    return;
  }
  state->size = controller.save(state->bytes);
  const bool taken = state->size > 0;
  state->first_tick.store(taken ? next_tick : kNoTick, std::memory_order_relaxed);
  state->use.store(Use::nobody, std::memory_order_release);
  if (taken) {
    state_due_ = next_tick + kTicksBetweenStates;
  }
}

// Takes the oldest state for the loop, an empty one first. Returns null if the reader holds it.
FlightRecorder::State* FlightRecorder::oldest_free() {
  State* best = nullptr;
  for (State& state : states_) {
    // An empty state gets age 0, because kNoTick + 1 is 0.
    const std::uint64_t age = state.first_tick.load(std::memory_order_relaxed) + 1;
    const bool older =
        best == nullptr || age < best->first_tick.load(std::memory_order_relaxed) + 1;
    Use nobody = Use::nobody;
    if (older && state.use.compare_exchange_strong(nobody, Use::loop, std::memory_order_acquire)) {
      if (best != nullptr) {
        best->use.store(Use::nobody, std::memory_order_release);
      }
      best = &state;
    }
  }
  return best;
}

bool FlightRecorder::can_serve(std::uint64_t first_tick, std::uint64_t end_tick) const {
  return first_tick <= end_tick && end_tick - first_tick <= kOldest &&
         first_tick > ticks_.begin_tick();
}

std::optional<FlightWindow> FlightRecorder::hold() {
  release();
  const std::uint64_t end_tick = ticks_.end_tick();
  // Each state is taken before its number is read, so that the loop cannot replace it meanwhile. Of
  // two taken ones the worse is given back at once.
  for (std::size_t i = 0; i < kStates; ++i) {
    Use nobody = Use::nobody;
    if (!states_[i].use.compare_exchange_strong(nobody, Use::reader, std::memory_order_acquire)) {
      continue;
    }
    const std::uint64_t first_tick = states_[i].first_tick.load(std::memory_order_relaxed);
    const bool better = can_serve(first_tick, end_tick) &&
                        (held_ == kNoState ||
                         first_tick < states_[held_].first_tick.load(std::memory_order_relaxed));
    const std::size_t other = better ? held_ : i;
    held_ = better ? i : held_;
    if (other != kNoState) {
      states_[other].use.store(Use::nobody, std::memory_order_release);
    }
  }
  if (held_ == kNoState) {
    return std::nullopt;
  }
  const State& state = states_[held_];
  return FlightWindow{.first_tick = state.first_tick.load(std::memory_order_relaxed),
                      .end_tick = end_tick,
                      .state = state.bytes.first(state.size)};
}

void FlightRecorder::release() {
  if (held_ != kNoState) {
    states_[held_].use.store(Use::nobody, std::memory_order_release);
    held_ = kNoState;
  }
}

}  // namespace tactus::firmware
