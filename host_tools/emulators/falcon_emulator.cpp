#include "host_tools/emulators/falcon_emulator.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace tactus::host {

namespace {

// The two status bytes of an FTDI chip without errors; the driver ignores their values.
constexpr std::array kChipStatus = {std::byte{0x31}, std::byte{0x60}};
// The divisors for the baud rate by which the host selects firmware, greeting and loader, and the
// loader's greeting.
constexpr std::uint16_t kBaudNormal = 0x0002;
constexpr std::uint16_t kBaudGreeting = 0x4138;
constexpr std::uint16_t kBaudLoader = 0x0015;
constexpr std::string_view kGreeting = "\x0A\x43\x0D";
constexpr std::string_view kGreetingAnswer = "\x0A\x44\x2C\x0D";
// The encoder's disc has 320 slots, read four times each; the capstan has 14.25 mm, the arm's arc
// 110 mm. The firmware's zero is at 35 degrees.
constexpr double kArmDegreesPerCount = 360.0 * 14.25 / (320.0 * 4.0 * 110.0);
constexpr double kArmDegreesAtZero = 35.0;

double degrees(double rad) {
  return rad * 180.0 / std::numbers::pi;
}

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
      homed_(config.homed ? std::uint8_t{7} : std::uint8_t{0}),
      firmware_loaded_(config.firmware_loaded) {}

void FalconEmulator::set_fault(EmulatorFault fault) {
  fault_ = fault;
  off_until_ns_ = 0;
  if (fault == EmulatorFault::erroring) {
    homed_ = 0;
    was_out_ = {};
  }
  if (fault == EmulatorFault::unplugged || fault == EmulatorFault::power_cycled) {
    cut_power();
  }
}

// Cable and supply count as one: firmware, reference and torque are lost.
void FalconEmulator::cut_power() {
  firmware_loaded_ = false;
  homed_ = 0;
  was_out_ = {};
  origin_known_ = false;
  motors_ = {};
  loader_ = Loader::idle;
  output_.clear();
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
        output_.clear();
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
      latency_ms_ = static_cast<std::uint8_t>(std::max<std::uint16_t>(1, value));
      return true;
    default:
      return false;
  }
}

// The host starts an upload by the greeting's baud rate and ends it by the normal one.
void FalconEmulator::set_baud(std::uint16_t code) {
  baud_ = code;
  command_.clear();
  if (code == kBaudGreeting) {
    loader_ = Loader::idle;
    firmware_loaded_ = false;
    homed_ = 0;
  } else if (code == kBaudNormal && loader_ == Loader::loading) {
    firmware_loaded_ = image_.size() == config_.image_bytes;
    loader_ = Loader::idle;
  }
}

bool FalconEmulator::has_power(hal::TimeNs now_ns) {
  if (fault_ == EmulatorFault::power_cycled && off_until_ns_ == 0) {
    off_until_ns_ = now_ns + kPowerCycle_ns;
  }
  return fault_ != EmulatorFault::unplugged &&
         (fault_ != EmulatorFault::power_cycled || now_ns >= off_until_ns_);
}

void FalconEmulator::receive(hal::TimeNs now_ns, std::span<const std::byte> bytes) {
  if (!has_power(now_ns)) {
    return;
  }
  for (const std::byte byte : bytes) {
    if (baud_ == kBaudNormal && firmware_loaded_) {
      take_firmware_byte(now_ns, byte);
    } else if (baud_ == kBaudGreeting || baud_ == kBaudLoader) {
      take_loader_byte(now_ns, byte);
    }
  }
}

// The loader greets, waits for 'A' at its own baud rate, and echoes every byte of the image.
void FalconEmulator::take_loader_byte(hal::TimeNs now_ns, std::byte byte) {
  const hal::TimeNs due_ns = now_ns + config_.answer_ns;
  if (loader_ == Loader::loading) {
    image_.push_back(byte);
    send(due_ns, {&byte, 1});
    return;
  }
  if (baud_ == kBaudLoader) {
    if (loader_ == Loader::greeted && byte == std::byte{0x41}) {
      loader_ = Loader::loading;
      image_.clear();
      send(due_ns, {&byte, 1});
    }
    return;
  }
  command_.push_back(byte);
  if (!std::ranges::equal(command_, bytes_of(kGreeting.substr(0, command_.size())))) {
    command_.clear();
  } else if (command_.size() == kGreeting.size()) {
    command_.clear();
    loader_ = Loader::greeted;
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
  ++commands_;
  const std::span<const std::byte> packet(command_);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    motors_[arm] = motor_value(packet.subspan(1 + 4 * arm, 4));
    // A positive value pulls toward the base.
    shafts_[arm].torque_Nm = -motors_[arm] / config_.motor_units_per_Nm;
  }
  const auto flags = static_cast<unsigned>(nibble(packet[13]));
  homing_ = (flags & 1U) != 0;
  lights_ = static_cast<std::uint8_t>(flags & 0xEU);
  watch_homing();
  answer(now_ns);
}

// Until an arm is homed its encoder counts from where it woke up.
void FalconEmulator::watch_homing() {
  if (!origin_known_) {
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      origin_rad_[arm] = shafts_[arm].position_rad;
    }
    origin_known_ = true;
  }
  for (std::size_t arm = 0; homing_ && arm < kArms; ++arm) {
    was_out_[arm] = was_out_[arm] || shafts_[arm].position_rad > config_.pulled_out_rad;
    if (was_out_[arm] && shafts_[arm].position_rad < config_.pushed_in_rad) {
      homed_ = static_cast<std::uint8_t>(homed_ | (1U << arm));
    }
  }
}

void FalconEmulator::answer(hal::TimeNs now_ns) {
  std::vector<std::byte> packet = {std::byte{'<'}};
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const bool homed = ((unsigned{homed_} >> arm) & 1U) != 0;
    const double counted = homed ? degrees(shafts_[arm].position_rad) - kArmDegreesAtZero
                                 : degrees(shafts_[arm].position_rad - origin_rad_[arm]);
    append_letters(packet, static_cast<int>(std::lround(counted / kArmDegreesPerCount)));
  }
  packet.push_back(static_cast<std::byte>('A' + buttons_ + 16 * homed_));
  packet.push_back(std::byte{'A'});
  packet.push_back(std::byte{'>'});
  send(now_ns + config_.answer_ns, packet);
}

void FalconEmulator::send(hal::TimeNs due_ns, std::span<const std::byte> bytes) {
  if (fault_ == EmulatorFault::silent) {
    return;
  }
  const hal::TimeNs at_ns = due_ns + (fault_ == EmulatorFault::delayed ? kFaultDelay_ns : 0);
  for (const std::byte byte : bytes) {
    output_.push_back({at_ns, byte});
  }
}

hal::TimeNs FalconEmulator::next_packet_ns() const {
  if (fault_ == EmulatorFault::unplugged) {
    return hal::kForever;
  }
  const hal::TimeNs idle_ns = last_packet_ns_ + hal::TimeNs{latency_ms_} * 1'000'000;
  return output_.empty() ? idle_ns : std::min(output_.front().due_ns, idle_ns);
}

// Each packet begins with the chip's two status bytes. The chip sends such an empty packet whenever
// the latency timer expires without data.
std::vector<std::byte> FalconEmulator::packet(hal::TimeNs now_ns) {
  if (now_ns < next_packet_ns()) {
    return {};
  }
  std::vector<std::byte> packet(kChipStatus.begin(), kChipStatus.end());
  const std::size_t room =
      config_.split_after > 0 ? kChipStatus.size() + config_.split_after : kUsbPacketBytes;
  while (!output_.empty() && output_.front().due_ns <= now_ns && packet.size() < room) {
    packet.push_back(output_.front().byte);
    output_.pop_front();
  }
  if (fault_ == EmulatorFault::corrupted && packet.size() > kChipStatus.size()) {
    std::uniform_int_distribution<std::size_t> bit(8 * kChipStatus.size(), 8 * packet.size() - 1);
    const std::size_t at = bit(random_);
    packet[at / 8] ^= static_cast<std::byte>(1U << (at % 8));
  }
  last_packet_ns_ = now_ns;
  return packet;
}

}  // namespace tactus::host
