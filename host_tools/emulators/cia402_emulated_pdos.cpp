// The process data objects (PDOs) of an emulated CiA 402 drive, as the master has mapped them.
#include "host_tools/emulators/cia402_emulator.h"
#include "host_tools/emulators/cia402_frame.h"

namespace tactus::host {

namespace {

// The error code of a frame that is too short for the objects mapped to it.
constexpr std::uint16_t kPdoTooShort = 0x8210;

// The object that an entry of a PDO mapping names, and its size.
struct Mapped {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  std::size_t bytes = 0;
};

// An entry is index, subindex and length in bits: 16, 8 and 8 bits from the top.
Mapped mapped(std::uint32_t entry) {
  return {static_cast<std::uint16_t>(entry >> 16U), static_cast<std::uint8_t>(entry >> 8U & 0xFFU),
          (entry & 0xFFU) / 8U};
}

}  // namespace

// Applies the receive PDOs that waited for the SYNC, then samples and sends the transmit PDOs that
// are due: types 1 to 240 are sent with every n-th SYNC.
void Cia402Emulator::take_sync(hal::TimeNs now_ns) {
  for (std::size_t pdo = 0; pdo < pdos_.received.size(); ++pdo) {
    if (pdos_.received[pdo].waits) {
      pdos_.received[pdo].waits = false;
      apply_pdo(now_ns, pdo, pdos_.received[pdo].frame);
    }
  }
  refresh_measured();
  for (std::size_t pdo = 0; pdo < pdos_.syncs.size(); ++pdo) {
    const auto communication = static_cast<std::uint16_t>(0x1800 + pdo);
    const std::uint32_t every = objects_.value(communication, 2);
    if ((objects_.value(communication, 1) & kCia402PdoOff) == 0 && every >= 1 && every <= 240 &&
        ++pdos_.syncs[pdo] >= every) {
      pdos_.syncs[pdo] = 0;
      send_pdo(now_ns, pdo);
    }
  }
}

// Types 0 to 240 wait for the SYNC; higher ones take effect on receipt.
void Cia402Emulator::take_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame) {
  if (objects_.value(static_cast<std::uint16_t>(0x1400 + pdo), 2) <= 240) {
    pdos_.received[pdo] = {frame, true};
  } else {
    apply_pdo(now_ns, pdo, frame);
  }
}

void Cia402Emulator::apply_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame) {
  const auto mapping = static_cast<std::uint16_t>(0x1600 + pdo);
  std::size_t at = 0;
  for (std::uint32_t entry = 1; entry <= objects_.value(mapping, 0); ++entry) {
    const Mapped to = mapped(objects_.value(mapping, static_cast<std::uint8_t>(entry)));
    if (at + to.bytes > frame.length) {
      send_emergency(now_ns, kPdoTooShort);
      return;
    }
    write_object({to.index, to.sub}, number_at(frame, at, to.bytes),
                 static_cast<std::uint32_t>(to.bytes));
    at += to.bytes;
  }
}

void Cia402Emulator::send_pdo(hal::TimeNs now_ns, std::size_t pdo) {
  const auto mapping = static_cast<std::uint16_t>(0x1A00 + pdo);
  hal::CanFrame frame{.id = objects_.value(static_cast<std::uint16_t>(0x1800 + pdo), 1) & 0x7FFU};
  std::size_t at = 0;
  for (std::uint32_t entry = 1; entry <= objects_.value(mapping, 0); ++entry) {
    const Mapped from = mapped(objects_.value(mapping, static_cast<std::uint8_t>(entry)));
    if (at + from.bytes > hal::kMaxCanBytes) {
      break;
    }
    write_number(frame, at, from.bytes, objects_.value(from.index, from.sub));
    at += from.bytes;
  }
  frame.length = static_cast<std::uint8_t>(at);
  send(now_ns, frame);
}

}  // namespace tactus::host
