// A serial line in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hal/serial_port.h"
#include "hal/simulated/clock.h"
#include "hal/simulated/fixed_queue.h"

namespace tactus::hal {

struct SimulatedSerialConfig {
  TimeNs byte_time_ns = 0;  // on the line: 86,806 at 115,200 baud; 0: a virtual port over USB
  TimeNs latency_ns = 0;    // on top, for each byte
};

// One end of a line; `connect` it to the other end, where an emulated device or a test sits.
//
// Fakes: bytes that take time, bounded buffers at the receiving end, a device that takes only part,
// failing calls, unplugging and coming back.
// Does not fake: baud rates that differ, framing errors, flow control.
class SimulatedSerialPort final : public SerialPort, private SimulatedEventSource {
 public:
  static constexpr std::size_t kBufferBytes = 4096;

  explicit SimulatedSerialPort(SimulatedClock& clock, const SimulatedSerialConfig& config = {});
  SimulatedSerialPort(const SimulatedSerialPort&) = delete;
  SimulatedSerialPort& operator=(const SimulatedSerialPort&) = delete;
  ~SimulatedSerialPort();

  // The two ends of one line. Both must outlive its use.
  void connect(SimulatedSerialPort& other);

  // Faults. What is written beyond `bytes` waits for a taker; kTakeAll ends it.
  void take_only(std::size_t bytes) { will_take_ = bytes; }
  void fail_next(std::uint32_t count, ErrorCode code);  // reads and writes
  // Every call fails with disconnected, and what is on the line is lost, until plugged in and
  // reopened. The other end notices nothing but silence.
  void unplug();
  void plug_in();

  static constexpr std::size_t kTakeAll = std::numeric_limits<std::size_t>::max();

 private:
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

  Result<void> check();
  std::size_t room() const;
  void carry(std::byte byte);

  SimulatedClock& clock_;
  SimulatedSerialConfig config_;
  SimulatedSerialPort* other_ = nullptr;
  FixedQueue<OnTheLine, kBufferBytes> line_;  // on the way to us
  FixedQueue<std::byte, kBufferBytes> input_;
  TimeNs line_free_ns_ = 0;  // when the last byte that we sent has left
  std::size_t will_take_ = kTakeAll;
  std::uint32_t failing_ = 0;
  ErrorCode failure_code_ = ErrorCode::io;
  enum class Plug : std::uint8_t { in, out, back } plug_ = Plug::in;
};

}  // namespace tactus::hal
