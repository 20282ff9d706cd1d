// A serial line in memory, between a driver and an emulated device. One thread; see
// simulated/clock.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hal/serial_port.h"
#include "hal/simulated/clock.h"
#include "hal/simulated/fixed_queue.h"

namespace tactus::hal {

// The speed of one end.
struct SimulatedSerialConfig {
  // The duration of a byte on the line, ns: 86,806 at 115,200 baud; 0 is a virtual port over USB.
  TimeNs byte_time_ns = 0;
  // The additional delay of each byte, ns.
  TimeNs latency_ns = 0;
};

// One end of a line. `connect` it to the other end, which an emulated device or a test uses.
//
// Simulated: the time that bytes take, bounded buffers at the receiving end, a device that takes
// only a part, failing calls, unplugging and coming back.
// Not simulated: different baud rates, framing errors, flow control.
class SimulatedSerialPort final : public SerialPort, private SimulatedEventSource {
 public:
  // The room at the receiving end for bytes on the line and unread ones together.
  static constexpr std::size_t kBufferBytes = 4096;

  // The clock must outlive this.
  explicit SimulatedSerialPort(SimulatedClock& clock, const SimulatedSerialConfig& config = {});
  SimulatedSerialPort(const SimulatedSerialPort&) = delete;
  SimulatedSerialPort& operator=(const SimulatedSerialPort&) = delete;
  ~SimulatedSerialPort();

  // Connects the two ends of a line. Both must outlive its use.
  void connect(SimulatedSerialPort& other);

  // The following functions cause faults. This one accepts only the next `bytes` bytes; later ones
  // wait. kTakeAll ends the fault.
  void take_only(std::size_t bytes) { will_take_ = bytes; }
  // Makes the next `count` reads or writes fail with `code`.
  void fail_next(std::uint32_t count, ErrorCode code);
  // Loses the bytes on the line and makes every call return `disconnected`, until plug_in() and
  // reopen(). The other end only sees that no bytes come.
  void unplug();
  // Makes the device available again, so that reopen() succeeds.
  void plug_in();

  // The value of take_only() that ends the fault.
  static constexpr std::size_t kTakeAll = std::numeric_limits<std::size_t>::max();

 private:
  // A byte and when it arrives at this end.
  struct OnTheLine {
    TimeNs arrives_ns = 0;
    std::byte byte{};
  };

  Result<std::size_t> DoWrite(std::span<const std::byte> bytes, TimeNs deadline_ns) override;
  Result<std::size_t> DoRead(std::span<std::byte> buffer, TimeNs deadline_ns) override;
  Result<void> DoDiscardInput() override;
  Result<void> DoReopen() override;

  TimeNs next_event_ns() const override;
  void run_event() override;

  // Returns the error of an unplugged or failing port.
  Result<void> check();
  // Returns how many bytes a write can take now.
  std::size_t room() const;
  // Puts a byte on the line to the other end.
  void carry(std::byte byte);

  SimulatedClock& clock_;
  SimulatedSerialConfig config_;
  SimulatedSerialPort* other_ = nullptr;
  FixedQueue<OnTheLine, kBufferBytes> line_;   // bytes on the way to this end
  FixedQueue<std::byte, kBufferBytes> input_;  // bytes that have arrived
  TimeNs line_free_ns_ = 0;                    // when the last byte sent by this end has left
  std::size_t will_take_ = kTakeAll;
  std::uint32_t failing_ = 0;
  ErrorCode failure_code_ = ErrorCode::io;
  enum class Plug : std::uint8_t { in, out, back } plug_ = Plug::in;
};

}  // namespace tactus::hal
