// CAN and CAN FD frames, error reports and receive filters, with the rules that every
// implementation of CanBus shares. All are plain values and pure functions, for any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"

namespace tactus::hal {

// The largest number of data bytes of a classic frame.
inline constexpr std::size_t kMaxCanBytes = 8;
// The same of a CAN FD frame.
inline constexpr std::size_t kMaxCanFdBytes = 64;
// The largest identifier of 11 bits.
inline constexpr std::uint32_t kMaxStandardId = 0x7FF;
// The largest identifier of 29 bits.
inline constexpr std::uint32_t kMaxExtendedId = 0x1FFF'FFFF;

// A frame as a driver sends or receives it. is_valid says which combinations are allowed.
struct CanFrame {
  // The identifier without flag bits: 11 bits, or 29 if `extended`. A lower one wins the bus.
  std::uint32_t id = 0;
  // True for an identifier of 29 bits.
  bool extended = false;
  // True for a request for data. It carries a length but no bytes. It does not exist in CAN FD.
  bool remote = false;
  bool fd = false;
  // CAN FD only: the data phase runs at the bus's faster bit rate.
  bool bit_rate_switch = false;
  // CAN FD only: the sender is error passive. The sender's controller sets it.
  bool error_state_indicator = false;
  // The number of data bytes: 0 to 8; with CAN FD also 12, 16, 20, 24, 32, 48 or 64.
  std::uint8_t length = 0;
  // The data bytes; those from `length` on have no meaning.
  std::array<std::byte, kMaxCanFdBytes> data{};

  // Returns the `length` data bytes; none for a remote request.
  std::span<const std::byte> bytes() const {
    return {data.data(), remote ? std::size_t{0} : length};
  }
};

// Returns true if identifier, flags and length are consistent: the identifier fits, the length is
// one that the kind of frame can have, no FD flag is set on a classic frame, and no FD frame is
// remote.
bool is_valid(const CanFrame& frame);

// Returns the smallest length of a CAN FD frame that holds `bytes` (at most 64): 9 -> 12.
std::uint8_t padded_fd_length(std::size_t bytes);

// The classes of error reports from the CAN controller. The bits are those of Linux error frames,
// so that an implementation need not translate them.
enum CanErrorClass : std::uint32_t {
  // The driver gave up a transmission.
  kCanTransmitTimeout = 0x001,
  // A frame with a lower identifier was sent first.
  kCanLostArbitration = 0x002,
  // The controller has a problem or changed its state: see CanErrorReport::controller.
  kCanController = 0x004,
  // A frame broke the rules of the bus: see CanErrorReport::protocol_type and protocol_place.
  kCanProtocol = 0x008,
  // The transceiver reports a broken or shorted wire: see CanErrorReport::transceiver.
  kCanTransceiver = 0x010,
  // No other node acknowledged the frame: nobody else is active on the bus.
  kCanNoAcknowledge = 0x020,
  // The controller left the bus: see CanBus::restart.
  kCanBusOff = 0x040,
  // A frame was disturbed. There is one report for each, so there may be very many.
  kCanBusError = 0x080,
  // The controller is on the bus again.
  kCanRestarted = 0x100,
  // CanErrorReport::transmit_errors and receive_errors are valid
  kCanErrorCounters = 0x200,
  kCanEveryErrorClass = 0x3FF,
};

// Bits of CanErrorReport::controller. The first two are losses, the others are new states of the
// transmit or the receive counter (see CanState).
enum CanControllerProblem : std::uint8_t {
  kCanReceiveOverflow = 0x01,
  kCanTransmitOverflow = 0x02,
  kCanReceiveWarning = 0x04,
  kCanTransmitWarning = 0x08,
  kCanReceivePassive = 0x10,
  kCanTransmitPassive = 0x20,
  kCanBackToActive = 0x40,
};

// A report from the controller. A field has a meaning only if its class is set in `classes`.
struct CanErrorReport {
  std::uint32_t classes = 0;    // CanErrorClass bits
  std::uint8_t controller = 0;  // CanControllerProblem bits
  // The error in the frame: a value of CAN_ERR_PROT_* of the kernel (linux/can/error.h).
  std::uint8_t protocol_type = 0;
  // The place of the error in the frame: a value of CAN_ERR_PROT_LOC_*.
  std::uint8_t protocol_place = 0;
  // The state of the wires: a value of CAN_ERR_TRX_*.
  std::uint8_t transceiver = 0;
  // The controller's error counters, valid if kCanErrorCounters is set.
  std::uint8_t transmit_errors = 0;
  std::uint8_t receive_errors = 0;
};

// An item of the receive queue: a frame or an error report, in the order of arrival.
struct CanReceived {
  enum class Kind : std::uint8_t { frame, error };

  Kind kind = Kind::frame;
  // The time of reception, on the clock of Clock::now_ns.
  TimeNs time_ns = 0;
  // Valid if `kind` is frame.
  CanFrame frame;
  // Valid if `kind` is error.
  CanErrorReport error;
};

// A receive filter. A frame passes if (its word & mask) == (word & mask); with `inverted`, if not.
// The word is the kernel's can_id: the identifier, bit 31 for extended, bit 30 for remote. A mask
// without bit 31 does not distinguish standard and extended frames. A default filter lets every
// frame pass.
struct CanFilter {
  // Bits of the word: a frame with 29 bits of identifier, and a remote request.
  static constexpr std::uint32_t kExtended = 0x8000'0000;
  static constexpr std::uint32_t kRemote = 0x4000'0000;

  // The word that a frame's is compared with, and the bits of it that count.
  std::uint32_t word = 0;
  std::uint32_t mask = 0;
  // True: the frames that do not match pass.
  bool inverted = false;

  // Return a filter for the data frames of one identifier.
  static constexpr CanFilter standard(std::uint32_t id) {
    return {id, kExtended | kRemote | kMaxStandardId, false};
  }
  static constexpr CanFilter extended(std::uint32_t id) {
    return {id | kExtended, kExtended | kRemote | kMaxExtendedId, false};
  }
  // Returns a filter for all frames.
  static constexpr CanFilter everything() { return {}; }
};

// Returns the word that a filter compares: identifier, and the bits 31 and 30 of the frame's flags.
std::uint32_t filter_word(const CanFrame& frame);
// Returns true if the filter lets the frame pass.
bool passes(const CanFilter& filter, const CanFrame& frame);

}  // namespace tactus::hal
