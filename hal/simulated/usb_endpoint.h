// A USB interface in memory, and the device connected to it. One thread; see simulated/clock.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "hal/simulated/clock.h"
#include "hal/simulated/fixed_queue.h"
#include "hal/simulated/usb_flights.h"
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
  // Takes bytes of a bulk-out. A transfer may come in several parts.
  virtual void bulk_out(std::span<const std::byte> data) = 0;

 protected:
  SimulatedUsbPeer() = default;
  ~SimulatedUsbPeer() = default;
};

// The properties of the device's pipes.
struct SimulatedUsbConfig {
  // The size of a packet, at most SimulatedUsbEndpoint::kMaxPacketBytes.
  std::size_t max_packet_bytes = 64;
  // The time, ns, that a bulk-out takes to reach the device.
  TimeNs out_time_ns = 0;
};

// The host's end.
//
// Simulated: control and bulk transfers with deadlines, several in flight, short packets, packets
// longer than the room left; a device that stops answering, takes only a part, halts or fails;
// unplugging as on Linux, and coming back. Not simulated: enumeration, frames and bandwidth of the
// bus (the peer decides when an answer is there), the milliseconds that the cancellation of a
// transfer takes.
class SimulatedUsbEndpoint final : public UsbEndpoint, private SimulatedEventSource {
 public:
  // The largest size of a packet, bytes.
  static constexpr std::size_t kMaxPacketBytes = 512;
  // The largest number of packets that wait for the host.
  static constexpr std::size_t kMaxPackets = 64;

  // Clock and peer must outlive this.
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

  // The following functions cause faults. A stopped device neither answers nor takes bytes: every
  // deadline passes.
  void set_stopped(bool stopped);
  // Lets the device take the next `bytes` bytes of bulk-out; later ones wait. kTakeAll ends it.
  void take_only(std::size_t bytes);
  // Makes bulk transfers return `stalled`, also those in flight.
  void set_halted(bool halted);
  // Makes the next `count` bulk transfers fail with `code`.
  void fail_next(std::uint32_t count, ErrorCode code);
  // Makes every transfer fail with io, and after `departure_ns` with disconnected, as on Linux.
  void unplug(TimeNs departure_ns = 0);
  // Makes the device available again, so that reopen() succeeds.
  void plug_in();

  // The value of take_only() that ends the fault.
  static constexpr std::size_t kTakeAll = std::numeric_limits<std::size_t>::max();

 private:
  // A packet for bulk-in and when the host can read it.
  struct Packet {
    TimeNs ready_ns = 0;
    std::size_t size = 0;
    std::array<std::byte, kMaxPacketBytes> bytes{};
  };
  // The cable is plugged in, unplugged, or plugged in again but not yet opened again.
  enum class Cable : std::uint8_t { in, out, back };
  // The connection to the device.
  struct Plug {
    Cable cable = Cable::in;
    // When an unplugged device leaves the bus.
    TimeNs departure_ns = 0;
  };
  // The faults that are set; the functions that set them describe them.
  struct Faults {
    bool is_stopped = false;
    bool is_halted = false;
    // The bytes of bulk-out that the device still takes.
    std::size_t will_take = kTakeAll;
    // The number of bulk transfers that are still to fail, and the error with which they do.
    std::uint32_t failing = 0;
    ErrorCode failure_code = ErrorCode::io;
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

  // Returns the state as Linux would report it now: an unplugged device stays attached for a while.
  UsbState current_state() const;
  Result<void> check_present() const;
  // Waits while the device is stopped. Returns `timeout`, or the error of an absent device.
  Result<void> wait_for_device(TimeNs deadline_ns);
  // Serves the transfers in flight as far as possible now.
  void serve();
  // Advance the oldest transfer of a direction by one step. Return false if nothing can be done
  // now.
  bool serve_out();
  bool serve_in();
  // Ends a transfer in flight and removes it from the list.
  void finish(UsbTransfer& transfer, Result<void> outcome);
  void fail_all(ErrorCode code);

  SimulatedClock& clock_;
  SimulatedUsbPeer& peer_;
  SimulatedUsbConfig config_;
  FixedQueue<Packet, kMaxPackets> packets_;
  UsbFlights flights_;
  // When the device has the data of the last bulk-out.
  TimeNs last_due_ns_ = 0;
  Plug plug_;
  Faults faults_;
  // True while serve() runs.
  bool serving_ = false;
};

}  // namespace tactus::hal
