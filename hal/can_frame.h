// CAN and CAN FD frames, error reports and receive filters, with their rules.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"

namespace tactus::hal {

inline constexpr std::size_t kMaxCanBytes = 8;
inline constexpr std::size_t kMaxCanFdBytes = 64;
inline constexpr std::uint32_t kMaxStandardId = 0x7FF;
inline constexpr std::uint32_t kMaxExtendedId = 0x1FFF'FFFF;

struct CanFrame {
  std::uint32_t id = 0;  // 11 bits, or 29 if extended; no flag bits
  bool extended = false;
  bool remote = false;  // a request for data; carries a length but no bytes. Not in CAN FD
  bool fd = false;
  bool bit_rate_switch = false;        // CAN FD only: the data phase runs at the faster rate
  bool error_state_indicator = false;  // CAN FD only: the sender is error passive
  std::uint8_t length = 0;             // bytes: 0..8; CAN FD also 12, 16, 20, 24, 32, 48, 64
  std::array<std::byte, kMaxCanFdBytes> data{};

  std::span<const std::byte> bytes() const {
    return {data.data(), remote ? std::size_t{0} : length};
  }
};

// Returns true if identifier, flags and length are consistent.
bool is_valid(const CanFrame& frame);

// Returns the smallest length of a CAN FD frame that holds `bytes` (at most 64): 9 -> 12.
std::uint8_t padded_fd_length(std::size_t bytes);

// The classes of error reports from the CAN controller. The bits are those of Linux error frames.
enum CanErrorClass : std::uint32_t {
  kCanTransmitTimeout = 0x001,
  kCanLostArbitration = 0x002,
  kCanController = 0x004,  // see CanErrorReport::controller
  kCanProtocol = 0x008,
  kCanTransceiver = 0x010,
  kCanNoAcknowledge = 0x020,  // no other node is active on the bus
  kCanBusOff = 0x040,
  kCanBusError = 0x080,  // one report for every disturbed frame: there may be very many
  kCanRestarted = 0x100,
  kCanErrorCounters = 0x200,
  kCanEveryErrorClass = 0x3FF,
};

// Bits of CanErrorReport::controller.
enum CanControllerProblem : std::uint8_t {
  kCanReceiveOverflow = 0x01,
  kCanTransmitOverflow = 0x02,
  kCanReceiveWarning = 0x04,
  kCanTransmitWarning = 0x08,
  kCanReceivePassive = 0x10,
  kCanTransmitPassive = 0x20,
  kCanBackToActive = 0x40,
};

struct CanErrorReport {
  std::uint32_t classes = 0;         // CanErrorClass bits
  std::uint8_t controller = 0;       // CanControllerProblem bits
  std::uint8_t protocol_type = 0;    // a value of CAN_ERR_PROT_* of the kernel
  std::uint8_t protocol_place = 0;   // a value of CAN_ERR_PROT_LOC_*
  std::uint8_t transceiver = 0;      // a value of CAN_ERR_TRX_*
  std::uint8_t transmit_errors = 0;  // both counters are valid if kCanErrorCounters is set
  std::uint8_t receive_errors = 0;
};

// An item of the receive queue: a frame or an error report, in the order of arrival.
struct CanReceived {
  enum class Kind : std::uint8_t { frame, error };

  Kind kind = Kind::frame;
  TimeNs time_ns = 0;    // when it was received, on the clock of Clock::now_ns
  CanFrame frame;        // if kind == frame
  CanErrorReport error;  // if kind == error
};

// A filter that lets a frame pass if (its word & mask) == (word & mask); an inverted one if not.
// The word is the kernel's can_id: the identifier, bit 31 for extended, bit 30 for remote. A mask
// without bit 31 does not distinguish standard and extended frames.
struct CanFilter {
  static constexpr std::uint32_t kExtended = 0x8000'0000;
  static constexpr std::uint32_t kRemote = 0x4000'0000;

  std::uint32_t word = 0;
  std::uint32_t mask = 0;
  bool inverted = false;

  // Return a filter for the data frames of one identifier.
  static constexpr CanFilter standard(std::uint32_t id) {
    return {id, kExtended | kRemote | kMaxStandardId, false};
  }
  static constexpr CanFilter extended(std::uint32_t id) {
    return {id | kExtended, kExtended | kRemote | kMaxExtendedId, false};
  }
  static constexpr CanFilter everything() { return {}; }
};

std::uint32_t filter_word(const CanFrame& frame);
bool passes(const CanFilter& filter, const CanFrame& frame);

}  // namespace tactus::hal
