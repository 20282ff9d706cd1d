#include "host_tools/emulators/haply_emulator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace tactus::host {

namespace {

// The firmware clamps every torque to this.
constexpr double kBoardTorqueLimit_Nm = 0.123;
constexpr double kFullTurn_deg = 360.0;

void append_float(std::vector<std::byte>& bytes, double value) {
  const auto bits = std::bit_cast<std::array<std::byte, 4>>(static_cast<float>(value));
  static_assert(std::endian::native == std::endian::little);
  bytes.insert(bytes.end(), bits.begin(), bits.end());
}

}  // namespace

void HaplyEmulator::set_fault(EmulatorFault fault) {
  fault_.set(fault);
  if (fault == EmulatorFault::erroring || fault == EmulatorFault::unplugged ||
      fault == EmulatorFault::power_cycled) {
    restart();
  }
}

// The board forgets its setup, and its motors lose their torque.
void HaplyEmulator::restart() {
  setup_ = {};
  command_.waits_for = Waiting::nothing;
  heard_.clear();
  late_.clear();
  for (EmulatedShaft& shaft : shafts_) {
    shaft.torque_Nm = 0.0;
  }
}

void HaplyEmulator::run(hal::TimeNs now_ns) {
  hear();
  if (!fault_.has_power(now_ns)) {
    heard_.clear();
    return;
  }
  do {
    if (command_.waits_for == Waiting::nothing && !heard_.empty()) {
      start_command();
    }
  } while (finish_command(now_ns) && !heard_.empty());
  while (!late_.empty() && late_.front().due_ns <= now_ns) {
    // A host that does not listen loses what the board sends.
    (void)port_.write(late_.front().bytes, hal::kNoWait);
    late_.pop_front();
  }
}

void HaplyEmulator::hear() {
  std::array<std::byte, 256> buffer;
  while (const auto got = port_.read(buffer, hal::kNoWait)) {
    heard_.insert(heard_.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*got));
  }
}

std::uint8_t HaplyEmulator::byte_if_there() {
  if (heard_.empty()) {
    return 0xFF;
  }
  const auto value = std::to_integer<std::uint8_t>(heard_.front());
  heard_.pop_front();
  return value;
}

double HaplyEmulator::next_float() {
  std::array<std::byte, 4> bytes;
  std::copy_n(heard_.begin(), 4, bytes.begin());
  heard_.erase(heard_.begin(), heard_.begin() + 4);
  return static_cast<double>(std::bit_cast<float>(bytes));
}

// Command 0 resets, 1 sets up, 2 commands torques.
void HaplyEmulator::start_command() {
  const std::uint8_t type = byte_if_there();
  command_.device_id = byte_if_there();
  switch (type) {
    // A reset forgets the setup; the motors keep their torque.
    case 0:
      setup_ = {};
      return;
    case 1:
      start_setup();
      return;
    case 2:
      for (std::size_t i = 0; i < setup_.pwm; ++i) {
        byte_if_there();
      }
      command_.waits_for = Waiting::torques;
      return;
    default:
      ++counts_.unknown_commands;
  }
}

// The setup lists motors, encoders, analogue inputs and PWM outputs, each as a mask or count and
// one byte for each; the encoders' floats follow.
void HaplyEmulator::start_setup() {
  command_.setup = {};
  const auto motors = static_cast<std::size_t>(std::popcount(byte_if_there() & 0xFU));
  for (std::size_t i = 0; i < motors; ++i) {
    command_.setup.motor_reversed.push_back(byte_if_there() == 1);
  }
  const auto encoders = static_cast<std::size_t>(std::popcount(byte_if_there() & 0xFU));
  for (std::size_t i = 0; i < encoders; ++i) {
    command_.setup.encoders.push_back({.reversed = byte_if_there() == 1});
  }
  command_.setup.analogue = byte_if_there() & 0xFU;
  for (std::size_t i = 0; i < command_.setup.analogue; ++i) {
    byte_if_there();
  }
  command_.setup.pwm = byte_if_there() & 0xFU;
  for (std::size_t i = 0; i < command_.setup.pwm; ++i) {
    byte_if_there();
  }
  command_.waits_for = Waiting::setup_floats;
}

// Returns false while the parser waits for the rest of a command.
bool HaplyEmulator::finish_command(hal::TimeNs now_ns) {
  const std::size_t floats = command_.waits_for == Waiting::torques ? setup_.motor_reversed.size()
                             : command_.waits_for == Waiting::setup_floats
                                 ? 2 * command_.setup.encoders.size()
                                 : 0;
  if (!floats_are_there(floats)) {
    return false;
  }
  if (command_.waits_for == Waiting::torques) {
    obey(now_ns);
  } else if (command_.waits_for == Waiting::setup_floats) {
    finish_setup();
  }
  command_.waits_for = Waiting::nothing;
  return true;
}

void HaplyEmulator::finish_setup() {
  for (std::size_t i = 0; i < command_.setup.encoders.size(); ++i) {
    EncoderSetup& encoder = command_.setup.encoders[i];
    encoder.preset_deg = next_float();
    encoder.counts_per_turn = next_float();
    encoder.angle_at_setup_rad = shafts_[i].position_rad;
  }
  setup_ = command_.setup;
  ++counts_.setups;
}

void HaplyEmulator::obey(hal::TimeNs now_ns) {
  ++counts_.torque_commands;
  for (std::size_t i = 0; i < setup_.motor_reversed.size(); ++i) {
    const double torque_Nm = std::clamp(next_float(), -kBoardTorqueLimit_Nm, kBoardTorqueLimit_Nm);
    shafts_[i].torque_Nm = setup_.motor_reversed[i] ? -torque_Nm : torque_Nm;
  }
  answer(now_ns);
}

void HaplyEmulator::answer(hal::TimeNs now_ns) {
  std::vector<std::byte> bytes = {static_cast<std::byte>(command_.device_id)};
  for (std::size_t i = 0; i < setup_.analogue; ++i) {
    append_float(bytes, 0.0);
  }
  for (std::size_t i = 0; i < setup_.encoders.size(); ++i) {
    const EncoderSetup& encoder = setup_.encoders[i];
    const double turned_rad = shafts_[i].position_rad - encoder.angle_at_setup_rad;
    const double turns = (encoder.reversed ? -turned_rad : turned_rad) / (2.0 * std::numbers::pi);
    const double preset = encoder.preset_deg / kFullTurn_deg * encoder.counts_per_turn;
    const double counts = std::round(preset + turns * encoder.counts_per_turn);
    append_float(bytes, kFullTurn_deg * counts / encoder.counts_per_turn);
  }
  if (fault_.is(EmulatorFault::silent)) {
    return;
  }
  if (fault_.is(EmulatorFault::corrupted)) {
    flip_a_bit(bytes, random_);
  }
  late_.push_back({now_ns + fault_.delay_ns(), bytes});
}

}  // namespace tactus::host
