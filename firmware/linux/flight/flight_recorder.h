// Keeps the last ticks of a run in static memory: the inputs and results of every tick, and states
// of the controller from which a replay can start.
//
// The loop adds each tick. Four states are kept, at distances of a quarter of the memory, so that
// at least five eighths of the memory can always be replayed. One other thread can hold a window
// and copy it while the loop goes on. A held state is not overwritten; reading a tick that has been
// overwritten fails.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/limits.h"
#include "firmware/linux/flight/flight_ticks.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

// A state and the ticks that follow it: the input of a replay.
struct FlightWindow {
  // The number of the first tick after the state.
  std::uint64_t first_tick = 0;
  // One beyond the number of the last tick.
  std::uint64_t end_tick = 0;
  // The bytes of Controller::save(), valid until release().
  std::span<const std::byte> state;
};

// The recorder of one controller. It holds kFlightTicks ticks of the first device and four states,
// so it belongs into static storage. It uses no heap and no locks, and never waits.
class FlightRecorder {
 public:
  // The number of states that are kept.
  static constexpr std::size_t kStates = 4;

  FlightRecorder() { use_room(own_room_); }
  FlightRecorder(const FlightRecorder&) = delete;
  FlightRecorder& operator=(const FlightRecorder&) = delete;
  ~FlightRecorder() = default;

  // Keeps the states in kStates equal parts of `room`, which must outlive the recorder, in place of
  // its own memory, which is enough for a controller with one device. Call before the first tick.
  void use_room(std::span<std::byte> room);

  // Adds the last tick of the first device. Copies it, and once in kFlightTicks / 4 ticks the
  // controller's state. Call from the loop's thread between ticks.
  void add(const RecordedTick& tick, Controller& controller);

  // Drops all ticks at the next add(), because they cannot be replayed together with later ones:
  // after a change of the scene or configure(). Call from the loop's thread.
  void forget() { ticks_.forget(); }

  // The next three are for one other thread.

  // Holds the longest window that can be copied safely. Returns nothing if there is no state, as
  // before the first tick. Hold one window at a time, until release(). This function and the next
  // two are for one thread beside the loop.
  std::optional<FlightWindow> hold();

  // Returns the ticks, to copy those of the window.
  [[nodiscard]] const FlightTicks& ticks() const { return ticks_; }

  // Gives the window up, so that the loop may overwrite its state.
  void release();

 private:
  static constexpr std::uint64_t kTicksBetweenStates = kFlightTicks / 4;
  // After a state could not be taken, the next attempt comes this many ticks later.
  static constexpr std::uint64_t kTicksToRetry = 256;
  // A window does not begin with an older tick, because the loop overwrites it soon.
  static constexpr std::uint64_t kOldest = kFlightTicks - kFlightTicks / 8;
  static constexpr std::uint64_t kNoTick = ~std::uint64_t{0};
  static constexpr std::size_t kNoState = kStates;

  // The thread that may use a state's bytes. A word: RISC-V has no atomic bytes.
  enum class Use : std::uint32_t { nobody, loop, reader };
  struct State {
    std::atomic<Use> use{Use::nobody};
    std::atomic<std::uint64_t> first_tick{kNoTick};  // the first tick after the state
    std::size_t size = 0;
    std::span<std::byte> bytes;
  };
  static_assert(std::atomic<Use>::is_always_lock_free &&
                std::atomic<std::uint64_t>::is_always_lock_free);

  // Forgets all states and starts with this tick.
  void begin(std::uint64_t tick);
  // Saves the controller's state into the oldest place that the reader does not hold.
  void take_state(std::uint64_t next_tick, Controller& controller);
  // Takes that place for the loop; null if there is none.
  State* oldest_free();
  // Returns true if the ticks between are there and stay there long enough.
  [[nodiscard]] bool can_serve(std::uint64_t first_tick, std::uint64_t end_tick) const;

  // Loop only: the tick after which the next state is saved.
  std::uint64_t state_due_ = 0;
  // Reader only: the index of the held state.
  std::size_t held_ = kNoState;
  std::array<State, kStates> states_{};
  FlightTicks ticks_;
  std::array<std::byte, kStates * kMaxCheckpointBytes> own_room_{};
};

}  // namespace tactus::firmware
