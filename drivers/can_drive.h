// The interface of a motor drive on a CAN bus: a state machine that takes frames and makes frames,
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

// The frames of one exchange, in the order of sending. Its size is fixed.
class CanOutbox {
 public:
  static constexpr std::size_t kCapacity = 48;

  // Adds a frame. Returns false, and adds nothing, if the outbox is full.
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

// Time comes in through the arguments, so a recorded or fuzzed run can be repeated. A drive has its
// own deadlines. A device that falls silent, reports an error or leaves torque mode latches a fault
// in `sample().status` and explains it in `trouble()`.
//   filters      writes the filters for the frames that the drive wants to the span, which has
//                room for kMaxFiltersPerDrive, and returns their number
//   start        forgets everything and begins to bring the device up at that time
//   take         takes one frame off the bus, the drive's own or not
//   request      adds the frames to send at the start of a tick, before the wait for samples
//   command      adds the frames to send at its end, with the torque clamped to the drive's limit.
//                Until the device is up, and after a fault, these frames bring it up or take its
//                power away, and ignore the command
//   sample       returns the newest sample; its time shows whether it is fresh
//   trouble      returns the latched fault in words, or an empty Trouble
//   clear_faults forgets latched faults and brings the device up again
//   shutdown     adds frames for zero torque and power off, for an orderly end
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
