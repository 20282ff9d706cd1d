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
  fault_ = fault;
  off_until_ns_ = 0;
  if (fault == EmulatorFault::erroring || fault == EmulatorFault::unplugged ||
      fault == EmulatorFault::power_cycled) {
    restart();
  }
}

// The board forgets its setup, and its motors lose their torque.
void HaplyEmulator::restart() {
  motor_reversed_.clear();
  encoders_.clear();
  analogue_ = 0;
  pwm_ = 0;
  waiting_ = Waiting::nothing;
  heard_.clear();
  late_.clear();
  for (EmulatedShaft& shaft : shafts_) {
    shaft.torque_Nm = 0.0;
  }
}

bool HaplyEmulator::has_power(hal::TimeNs now_ns) {
  if (fault_ == EmulatorFault::power_cycled && off_until_ns_ == 0) {
    off_until_ns_ = now_ns + kPowerCycle_ns;
  }
  return fault_ != EmulatorFault::unplugged &&
         (fault_ != EmulatorFault::power_cycled || now_ns >= off_until_ns_);
}

void HaplyEmulator::run(hal::TimeNs now_ns) {
  hear();
  if (!has_power(now_ns)) {
    heard_.clear();
    return;
  }
  do {
    if (waiting_ == Waiting::nothing && !heard_.empty()) {
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
  device_id_ = byte_if_there();
  switch (type) {
    // A reset forgets the setup; the motors keep their torque.
    case 0:
      motor_reversed_.clear();
      encoders_.clear();
      analogue_ = 0;
      pwm_ = 0;
      return;
    case 1:
      start_setup();
      return;
    case 2:
      for (std::size_t i = 0; i < pwm_; ++i) {
        byte_if_there();
      }
      waiting_ = Waiting::torques;
      return;
    default:
      ++unknown_;
  }
}

// The setup lists motors, encoders, analogue inputs and PWM outputs, each as a mask or count and
// one byte for each; the encoders' floats follow.
void HaplyEmulator::start_setup() {
  coming_ = {};
  const auto motors = static_cast<std::size_t>(std::popcount(byte_if_there() & 0xFU));
  for (std::size_t i = 0; i < motors; ++i) {
    coming_.motor_reversed.push_back(byte_if_there() == 1);
  }
  const auto encoders = static_cast<std::size_t>(std::popcount(byte_if_there() & 0xFU));
  for (std::size_t i = 0; i < encoders; ++i) {
    coming_.encoders.push_back({.reversed = byte_if_there() == 1});
  }
  coming_.analogue = byte_if_there() & 0xFU;
  for (std::size_t i = 0; i < coming_.analogue; ++i) {
    byte_if_there();
  }
  coming_.pwm = byte_if_there() & 0xFU;
  for (std::size_t i = 0; i < coming_.pwm; ++i) {
    byte_if_there();
  }
  waiting_ = Waiting::setup_floats;
}

// Returns false while the parser waits for the rest of a command.
bool HaplyEmulator::finish_command(hal::TimeNs now_ns) {
  const std::size_t floats = waiting_ == Waiting::torques        ? motor_reversed_.size()
                             : waiting_ == Waiting::setup_floats ? 2 * coming_.encoders.size()
                                                                 : 0;
  if (!floats_are_there(floats)) {
    return false;
  }
  if (waiting_ == Waiting::torques) {
    obey(now_ns);
  } else if (waiting_ == Waiting::setup_floats) {
    finish_setup();
  }
  waiting_ = Waiting::nothing;
  return true;
}

void HaplyEmulator::finish_setup() {
  for (std::size_t i = 0; i < coming_.encoders.size(); ++i) {
    EncoderSetup& encoder = coming_.encoders[i];
    encoder.preset_deg = next_float();
    encoder.counts_per_turn = next_float();
    encoder.angle_at_setup_rad = shafts_[i].position_rad;
  }
  motor_reversed_ = coming_.motor_reversed;
  encoders_ = coming_.encoders;
  analogue_ = coming_.analogue;
  pwm_ = coming_.pwm;
  ++setups_;
}

void HaplyEmulator::obey(hal::TimeNs now_ns) {
  ++commands_;
  for (std::size_t i = 0; i < motor_reversed_.size(); ++i) {
    const double torque_Nm = std::clamp(next_float(), -kBoardTorqueLimit_Nm, kBoardTorqueLimit_Nm);
    shafts_[i].torque_Nm = motor_reversed_[i] ? -torque_Nm : torque_Nm;
  }
  answer(now_ns);
}

void HaplyEmulator::answer(hal::TimeNs now_ns) {
  std::vector<std::byte> bytes = {static_cast<std::byte>(device_id_)};
  for (std::size_t i = 0; i < analogue_; ++i) {
    append_float(bytes, 0.0);
  }
  for (std::size_t i = 0; i < encoders_.size(); ++i) {
    const EncoderSetup& encoder = encoders_[i];
    const double turned_rad = shafts_[i].position_rad - encoder.angle_at_setup_rad;
    const double turns = (encoder.reversed ? -turned_rad : turned_rad) / (2.0 * std::numbers::pi);
    const double preset = encoder.preset_deg / kFullTurn_deg * encoder.counts_per_turn;
    const double counts = std::round(preset + turns * encoder.counts_per_turn);
    append_float(bytes, kFullTurn_deg * counts / encoder.counts_per_turn);
  }
  if (fault_ == EmulatorFault::silent) {
    return;
  }
  if (fault_ == EmulatorFault::corrupted) {
    std::uniform_int_distribution<std::size_t> bit(0, 8 * bytes.size() - 1);
    const std::size_t at = bit(random_);
    bytes[at / 8] ^= static_cast<std::byte>(1U << (at % 8));
  }
  late_.push_back({now_ns + (fault_ == EmulatorFault::delayed ? kFaultDelay_ns : 0), bytes});
}

}  // namespace tactus::host
