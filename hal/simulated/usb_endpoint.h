// A USB interface in memory, and the device connected to it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hal/simulated/clock.h"
#include "hal/simulated/fixed_queue.h"
#include "hal/usb_endpoint.h"

namespace tactus::hal {

// The device. The endpoint calls it during a transfer. It sends packets back through
// SimulatedUsbEndpoint::answer, at once or later (as a SimulatedEventSource).
class SimulatedUsbPeer {
 public:
  SimulatedUsbPeer(const SimulatedUsbPeer&) = delete;
  SimulatedUsbPeer& operator=(const SimulatedUsbPeer&) = delete;

  // Return the number of bytes taken or given, or the error for the host, mostly
  // failure(ErrorCode::stalled).
  virtual Result<std::size_t> control_out(const UsbSetup& setup,
                                          std::span<const std::byte> data) = 0;
  virtual Result<std::size_t> control_in(const UsbSetup& setup, std::span<std::byte> buffer) = 0;
  virtual void bulk_out(std::span<const std::byte> data) = 0;

 protected:
  SimulatedUsbPeer() = default;
  ~SimulatedUsbPeer() = default;
};

struct SimulatedUsbConfig {
  std::size_t max_packet_bytes = 64;  // at most SimulatedUsbEndpoint::kMaxPacketBytes
  TimeNs out_time_ns = 0;             // duration of a bulk-out
};

// Simulated: control and bulk transfers with deadlines, several in flight, short packets, packets
// longer than the room left; a device that stops answering, takes only a part, halts or fails;
// unplugging as on Linux, and coming back.
// Not simulated: enumeration, frames and bandwidth of the bus (the peer decides when an answer is
// there), the milliseconds that the cancellation of a transfer takes.
class SimulatedUsbEndpoint final : public UsbEndpoint, private SimulatedEventSource {
 public:
  static constexpr std::size_t kMaxPacketBytes = 512;
  static constexpr std::size_t kMaxPackets = 64;

  SimulatedUsbEndpoint(SimulatedClock& clock, SimulatedUsbPeer& peer,
                       const SimulatedUsbConfig& config = {});
  SimulatedUsbEndpoint(const SimulatedUsbEndpoint&) = delete;
  SimulatedUsbEndpoint& operator=(const SimulatedUsbEndpoint&) = delete;
  ~SimulatedUsbEndpoint();

  // Queues bytes for bulk-in, cut into packets; no bytes make one empty packet. The device calls
  // it. The host can read them `delay_ns` from now, after the packets queued before. Returns false
  // and queues nothing if there is no room or no device.
  bool answer(std::span<const std::byte> bytes, TimeNs delay_ns = 0);
  // Returns the number of packets that the host has not read yet.
  std::size_t packets_waiting() const { return packets_.size(); }

  // These cause faults. A stopped device neither answers nor takes bytes: every deadline passes.
  void set_stopped(bool stopped);
  void take_only(std::size_t bytes);  // bulk-out beyond these bytes waits; kTakeAll ends it
  void set_halted(bool halted);       // bulk transfers stall
  void fail_next(std::uint32_t count, ErrorCode code);  // bulk transfers
  // Makes every transfer fail with io, and after `departure_ns` with disconnected.
  void unplug(TimeNs departure_ns = 0);
  void plug_in();

  static constexpr std::size_t kTakeAll = std::numeric_limits<std::size_t>::max();

 private:
  struct Packet {
    TimeNs ready_ns = 0;
    std::size_t size = 0;
    std::array<std::byte, kMaxPacketBytes> bytes{};
  };
  struct Flight {
    UsbTransfer* transfer = nullptr;
    TimeNs due_ns = 0;  // bulk-out: when the device has the data
  };

  Result<std::size_t> DoControlOut(const UsbSetup& setup, std::span<const std::byte> data,
                                   TimeNs deadline_ns) override;
  Result<std::size_t> DoControlIn(const UsbSetup& setup, std::span<std::byte> buffer,
                                  TimeNs deadline_ns) override;
  Result<void> DoSubmit(UsbTransfer& transfer) override;
  void DoWait(UsbTransfer& transfer, TimeNs deadline_ns) override;
  void DoCancel(UsbTransfer& transfer) override;
  UsbState DoState() override { return current_state(); }
  Result<void> DoReopen() override;
  std::size_t DoMaxPacketBytes() const override { return config_.max_packet_bytes; }

  TimeNs next_event_ns() const override;
  void run_event() override { serve(); }

  UsbState current_state() const;
  Result<void> check_present() const;
  Result<void> wait_for_device(TimeNs deadline_ns);
  const Flight* oldest(UsbDirection direction) const;
  void serve();
  bool serve_out();
  bool serve_in();
  void finish(UsbTransfer& transfer, Result<void> outcome);
  void fail_all(ErrorCode code);

  SimulatedClock& clock_;
  SimulatedUsbPeer& peer_;
  SimulatedUsbConfig config_;
  FixedQueue<Packet, kMaxPackets> packets_;
  std::array<Flight, kMaxUsbTransfersInFlight> flights_{};
  std::size_t flight_count_ = 0;
  TimeNs last_due_ns_ = 0;
  TimeNs departure_ns_ = 0;
  std::size_t will_take_ = kTakeAll;
  std::uint32_t failing_ = 0;
  ErrorCode failure_code_ = ErrorCode::io;
  enum class Plug : std::uint8_t { in, out, back } plug_ = Plug::in;
  bool stopped_ = false;
  bool halted_ = false;
  bool serving_ = false;
};

}  // namespace tactus::hal
