// The part of CANopen (CiA 301) that the master of a motor drive needs: encodes and decodes frames.
// It has no input or output and no state. All numbers are little-endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/can_frame.h"

namespace tactus::drivers::canopen {

// The purpose of a frame. A frame's identifier is one of these, plus the node's number 1..127
// except for the first two. "Transmit" and "receive" are seen from the drive.
enum Service : std::uint32_t {
  kNmt = 0x000,
  kSync = 0x080,
  kEmergency = 0x080,
  kTransmitPdo1 = 0x180,
  kReceivePdo1 = 0x200,
  kTransmitPdo2 = 0x280,
  kSdoAnswer = 0x580,
  kSdoRequest = 0x600,
  kHeartbeat = 0x700,
};

enum class NmtCommand : std::uint8_t {
  start = 0x01,  // to operational: PDOs work
  stop = 0x02,
  enter_pre_operational = 0x80,  // SDOs work, PDOs do not
  reset_node = 0x81,
  reset_communication = 0x82,
};

enum class NmtState : std::uint8_t {
  boot_up = 0x00,
  stopped = 0x04,
  operational = 0x05,
  pre_operational = 0x7F,
};

// The content of an emergency message (EMCY).
struct Emergency {
  std::uint16_t code = 0;           // error code; 0: the errors are over
  std::uint8_t error_register = 0;  // as object 1001
  std::array<std::uint8_t, 5> vendor{};
};

// Returns true if the frame is of this service and node. It must be a classic data frame with an
// 11-bit identifier, since CANopen uses no other.
bool is_from(const hal::CanFrame& frame, std::uint32_t service, std::uint8_t node);

hal::CanFrame nmt_frame(NmtCommand command, std::uint8_t node);
hal::CanFrame sync_frame();
hal::CanFrame heartbeat_frame(std::uint8_t node, NmtState state);

// These decode a frame. They return nothing if it is not this node's, or malformed. An undefined
// state is returned as it is, so that the drive is not taken for operational.
std::optional<NmtState> heartbeat_of(const hal::CanFrame& frame, std::uint8_t node);
std::optional<Emergency> emergency_of(const hal::CanFrame& frame, std::uint8_t node);

}  // namespace tactus::drivers::canopen
