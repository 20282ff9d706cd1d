// What every motor drive on a CAN bus is to us: a state machine that takes frames and makes frames,
// without input or output of its own. CanBoard puts drives on a bus.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "hal/can_frame.h"

namespace tactus::drivers {

// The frames of one turn, in the order of sending. Fixed size: what does not fit is refused.
class CanOutbox {
 public:
  static constexpr std::size_t kCapacity = 48;

  // False, and nothing added, when full.
  bool add(const hal::CanFrame& frame) {
    if (size_ == kCapacity) {
      return false;
    }
    frames_[size_] = frame;
    ++size_;
    return true;
  }
  void clear() { size_ = 0; }
  [[nodiscard]] std::span<const hal::CanFrame> frames() const { return {frames_.data(), size_}; }

 private:
  std::array<hal::CanFrame, kCapacity> frames_{};
  std::size_t size_ = 0;
};

inline constexpr std::size_t kMaxFiltersPerDrive = 8;

// Time comes in through the arguments, so that a recorded or fuzzed run repeats. A drive has its
// own deadlines: a device that falls silent, reports an error or leaves torque mode latches a fault
// in `sample().status` and says so in `trouble()`.
//   filters      the frames it wants off the bus, written to the span (kMaxFiltersPerDrive); how
//                many
//   start        forgets everything and begins to bring the device up at that time
//   take         one frame off the bus, its own or not
//   request      frames to send at the start of a tick, before the samples are waited for
//   command      frames to send at its end, with the torque clamped to the drive's limit. Until the
//                device is up, and from a fault on, these bring it up or take its power away,
//                whatever the command says
//   sample       the newest; its time tells whether it is fresh
//   shutdown     torque zero and power off, for an orderly end
template <class D>
concept CanDrive = requires(D drive, const D& constant, std::span<hal::CanFilter> filters,
                            const hal::CanReceived& received, hal::TimeNs now_ns,
                            const AxisCommand& command, CanOutbox& outbox) {
  { constant.filters(filters) } -> std::same_as<std::size_t>;
  { drive.start(now_ns) } -> std::same_as<void>;
  { drive.take(received) } -> std::same_as<void>;
  { drive.request(now_ns, outbox) } -> std::same_as<void>;
  { drive.command(now_ns, command, outbox) } -> std::same_as<void>;
  { constant.sample() } -> std::same_as<const AxisSample&>;
  { constant.trouble() } -> std::same_as<Trouble>;
  { drive.clear_faults(now_ns) } -> std::same_as<void>;
  { drive.shutdown(outbox) } -> std::same_as<void>;
};

}  // namespace tactus::drivers
