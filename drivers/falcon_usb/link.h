// The USB connection of a Falcon: its endpoint, with the transfers that stay in flight across
// ticks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/falcon_usb/packet.h"
#include "hal/usb_endpoint.h"

namespace tactus::drivers {

// Four reads wait for the device's bytes, and two packets may be on their way to it.
class FalconLink {
 public:
  // The endpoint must outlive the link. It is open.
  explicit FalconLink(hal::UsbEndpoint& endpoint) : endpoint_(&endpoint) {}
  FalconLink(const FalconLink&) = delete;
  FalconLink& operator=(const FalconLink&) = delete;
  ~FalconLink() { withdraw_all(); }

  [[nodiscard]] hal::UsbEndpoint& endpoint() const { return *endpoint_; }

  // Begins a session: submits all reads. Returns the first error, as the next two calls do.
  hal::Result<void> start_reads();
  // Withdraws all transfers.
  void withdraw_all();

  // Waits for the oldest read. Returns its bytes, valid until `read_on`; nothing if it is not done
  // by the deadline or was never submitted; or the error with which it ended.
  hal::Result<std::optional<std::span<const std::byte>>> receive(hal::TimeNs deadline_ns);
  // Submits the oldest read again. Call it after each `receive` that returned bytes.
  hal::Result<void> read_on();

  // Checks the outcomes of the packets that were sent before. Returns the first error.
  hal::Result<void> check_writes();
  // Returns the place of the next packet.
  [[nodiscard]] std::size_t next_place() const { return next_write_; }
  // Returns true if the next place is free.
  [[nodiscard]] bool has_room() const { return !writes_[next_write_].on_its_way; }
  // Notes that a packet found no room. Returns the number of such packets since the last one that
  // was sent.
  std::uint32_t note_blocked() { return ++blocked_in_a_row_; }
  // Submits a packet. There is room.
  hal::Result<void> send(const FalconPacket& packet);
  // Waits until the packet in that place has gone out, or until the deadline.
  void wait_for(std::size_t place, hal::TimeNs deadline_ns);

 private:
  static constexpr std::size_t kUsbPacketBytes = 64;

  struct Read {
    std::array<std::byte, kUsbPacketBytes> buffer{};
    hal::UsbTransfer transfer = hal::UsbTransfer::in(buffer);
  };
  struct Write {
    FalconPacket packet{};
    hal::UsbTransfer transfer = hal::UsbTransfer::out(packet);
    bool on_its_way = false;  // submitted, its outcome not checked yet
  };

  hal::UsbEndpoint* endpoint_;
  std::array<Read, 4> reads_;
  std::array<Write, 2> writes_;
  std::size_t next_read_ = 0;
  std::size_t next_write_ = 0;
  std::uint32_t blocked_in_a_row_ = 0;
};

}  // namespace tactus::drivers
