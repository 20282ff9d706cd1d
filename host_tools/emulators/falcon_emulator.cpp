#include "host_tools/emulators/falcon_emulator.h"

#include <algorithm>
#include <string_view>

namespace tactus::host {

namespace {

// The divisors for the baud rate by which the host selects firmware, greeting and loader, and the
// loader's greeting.
constexpr std::uint16_t kBaudNormal = 0x0002;
constexpr std::uint16_t kBaudGreeting = 0x4138;
constexpr std::uint16_t kBaudLoader = 0x0015;
constexpr std::string_view kGreeting = "\x0A\x43\x0D";
constexpr std::string_view kGreetingAnswer = "\x0A\x44\x2C\x0D";

std::vector<std::byte> bytes_of(std::string_view text) {
  std::vector<std::byte> bytes(text.size());
  std::ranges::transform(text, bytes.begin(),
                         [](char letter) { return static_cast<std::byte>(letter); });
  return bytes;
}

// The firmware writes each half byte as a letter from 'A' on, the lowest half byte first.
int nibble(std::byte letter) {
  return std::to_integer<int>(letter) - 'A';
}

// Returns the signed number of four letters.
std::int16_t motor_value(std::span<const std::byte> letters) {
  return static_cast<std::int16_t>(nibble(letters[0]) + 16 * nibble(letters[1]) +
                                   256 * nibble(letters[2]) + 4096 * nibble(letters[3]));
}

// Appends the lowest 16 bits of a number as four letters.
void append_letters(std::vector<std::byte>& packet, int value) {
  auto rest = static_cast<unsigned>(value) & 0xFFFFU;
  for (int i = 0; i < 4; ++i) {
    packet.push_back(static_cast<std::byte>('A' + rest % 16U));
    rest /= 16U;
  }
}

}  // namespace

FalconEmulator::FalconEmulator(const FalconEmulatorConfig& config, std::uint32_t seed)
    : config_(config),
      random_(seed),
      homing_(config.homed),
      firmware_{.is_loaded = config.firmware_loaded} {}

void FalconEmulator::set_fault(EmulatorFault fault) {
  fault_.set(fault);
  if (fault == EmulatorFault::erroring) {
    homing_.start_again();
  }
  if (fault == EmulatorFault::unplugged || fault == EmulatorFault::power_cycled) {
    cut_power();
  }
}

// Cable and supply count as one: firmware, reference and torque are lost.
void FalconEmulator::cut_power() {
  firmware_.is_loaded = false;
  homing_.lose_power();
  obeyed_.motors = {};
  firmware_.loader = Loader::idle;
  chip_.drop_queue();
  command_.clear();
  for (EmulatedShaft& shaft : shafts_) {
    shaft.torque_Nm = 0.0;
  }
}

// Requests of an FTDI chip to the device: 0 reset, 1 modem control, 2 flow control, 3 baud rate, 4
// data format, 9 latency timer (ms).
bool FalconEmulator::control(std::uint8_t request_type, std::uint8_t request, std::uint16_t value) {
  if (request_type != 0x40) {
    return false;
  }
  switch (request) {
    // Value 1 empties what waits for the host, 2 what waits for the device.
    case 0:
      if (value == 1) {
        chip_.drop_queue();
      } else if (value == 2) {
        command_.clear();
      }
      return true;
    case 1:
    case 2:
    case 4:
      return true;
    case 3:
      set_baud(value);
      return true;
    case 9:
      chip_.set_latency(value);
      return true;
    default:
      return false;
  }
}

// The host starts an upload by the greeting's baud rate and ends it by the normal one.
void FalconEmulator::set_baud(std::uint16_t code) {
  chip_.set_baud_divisor(code);
  command_.clear();
  if (code == kBaudGreeting) {
    firmware_.loader = Loader::idle;
    firmware_.is_loaded = false;
    homing_.forget_references();
  } else if (code == kBaudNormal && firmware_.loader == Loader::loading) {
    firmware_.is_loaded = firmware_.image.size() == config_.image_bytes;
    firmware_.loader = Loader::idle;
  }
}

void FalconEmulator::receive(hal::TimeNs now_ns, std::span<const std::byte> bytes) {
  if (!fault_.has_power(now_ns)) {
    return;
  }
  const std::uint16_t baud = chip_.baud_divisor();
  for (const std::byte byte : bytes) {
    if (baud == kBaudNormal && firmware_.is_loaded) {
      take_firmware_byte(now_ns, byte);
    } else if (baud == kBaudGreeting || baud == kBaudLoader) {
      take_loader_byte(now_ns, byte);
    }
  }
}

// The loader greets, waits for 'A' at its own baud rate, and echoes every byte of the image.
void FalconEmulator::take_loader_byte(hal::TimeNs now_ns, std::byte byte) {
  const hal::TimeNs due_ns = now_ns + config_.answer_ns;
  if (firmware_.loader == Loader::loading) {
    firmware_.image.push_back(byte);
    send(due_ns, {&byte, 1});
    return;
  }
  if (chip_.baud_divisor() == kBaudLoader) {
    if (firmware_.loader == Loader::greeted && byte == std::byte{0x41}) {
      firmware_.loader = Loader::loading;
      firmware_.image.clear();
      send(due_ns, {&byte, 1});
    }
    return;
  }
  command_.push_back(byte);
  if (!std::ranges::equal(command_, bytes_of(kGreeting.substr(0, command_.size())))) {
    command_.clear();
  } else if (command_.size() == kGreeting.size()) {
    command_.clear();
    firmware_.loader = Loader::greeted;
    if (config_.leading_zero) {
      send(due_ns, std::array{std::byte{0}});
    }
    send(due_ns, bytes_of(kGreetingAnswer));
  }
}

// A command has 16 bytes from '<' to '>'; anything else is dropped.
void FalconEmulator::take_firmware_byte(hal::TimeNs now_ns, std::byte byte) {
  if (command_.empty() && byte != std::byte{'<'}) {
    return;
  }
  command_.push_back(byte);
  if (command_.size() < 16) {
    return;
  }
  if (command_.back() == std::byte{'>'}) {
    obey(now_ns);
  }
  command_.clear();
}

void FalconEmulator::obey(hal::TimeNs now_ns) {
  ++obeyed_.commands;
  const std::span<const std::byte> packet(command_);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    obeyed_.motors[arm] = motor_value(packet.subspan(1 + 4 * arm, 4));
    // A positive value pulls toward the base.
    shafts_[arm].torque_Nm = -obeyed_.motors[arm] / config_.motor_units_per_Nm;
  }
  const auto flags = static_cast<unsigned>(nibble(packet[13]));
  obeyed_.lights = static_cast<std::uint8_t>(flags & 0xEU);
  homing_.watch(shafts_, (flags & 1U) != 0);
  answer(now_ns);
}

void FalconEmulator::answer(hal::TimeNs now_ns) {
  std::vector<std::byte> packet = {std::byte{'<'}};
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    append_letters(packet, homing_.count(arm, shafts_[arm].position_rad));
  }
  packet.push_back(static_cast<std::byte>('A' + buttons_ + 16 * homing_.homed()));
  packet.push_back(std::byte{'A'});
  packet.push_back(std::byte{'>'});
  send(now_ns + config_.answer_ns, packet);
}

void FalconEmulator::send(hal::TimeNs due_ns, std::span<const std::byte> bytes) {
  if (!fault_.is(EmulatorFault::silent)) {
    chip_.queue(due_ns + fault_.delay_ns(), bytes);
  }
}

hal::TimeNs FalconEmulator::next_packet_ns() const {
  return fault_.is(EmulatorFault::unplugged) ? hal::kForever : chip_.next_packet_ns();
}

std::vector<std::byte> FalconEmulator::packet(hal::TimeNs now_ns) {
  if (fault_.is(EmulatorFault::unplugged)) {
    return {};
  }
  const std::size_t room =
      config_.split_after > 0 ? FtdiChip::kStatusBytes + config_.split_after : kUsbPacketBytes;
  std::vector<std::byte> packet = chip_.packet(now_ns, room);
  if (fault_.is(EmulatorFault::corrupted) && packet.size() > FtdiChip::kStatusBytes) {
    flip_a_bit(std::span(packet).subspan(FtdiChip::kStatusBytes), random_);
  }
  return packet;
}

}  // namespace tactus::host
