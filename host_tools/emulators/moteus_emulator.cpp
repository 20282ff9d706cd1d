// Encoded by hand from the facts about the register protocol, and never through the driver's code,
// so that an error in either shows.

#include "host_tools/emulators/moteus_emulator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace tactus::host {

namespace {

constexpr double kMoteusRevPerRad = 0.5 / std::numbers::pi;
// The modes of register 0x000. From `enabling` to `calibrated` the servo starts; above it runs.
constexpr int kMoteusStopped = 0;
constexpr int kMoteusFault = 1;
constexpr int kMoteusEnabling = 2;
constexpr int kMoteusCalibrated = 4;
constexpr int kMoteusPosition = 10;
constexpr int kMoteusTimeout = 11;
constexpr int kMoteusZeroVelocity = 12;
constexpr int kMoteusLastMode = 15;
// The fault code of register 0x00F for an error of the motor driver.
constexpr int kMotorDriverFaultCode = 33;
// The type of a register's value: 0 int8, 1 int16, 2 int32, 3 float.
constexpr unsigned kFloatType = 3;
// A servo that has not been run for this time was without power.
constexpr hal::TimeNs kMoteusPowerLoss_ns = 200'000'000;
constexpr double kMoteusVoltage_V = 24.0;
constexpr double kMoteusTemperature_C = 31.0;

// Returns the value of one bit of int8, int16 and int32 in that register; 1 for plain numbers.
std::array<double, 3> moteus_steps(unsigned at) {
  switch (at) {
    case 0x001:
    case 0x006:
    case 0x020:
    case 0x026:
      return {0.01, 0.0001, 0.00001};
    case 0x002:
    case 0x021:
    case 0x028:
      return {0.1, 0.00025, 0.00001};
    case 0x003:
    case 0x022:
    case 0x025:
      return {0.5, 0.01, 0.001};
    case 0x004:
    case 0x005:
    case 0x00E:
      return {1.0, 0.1, 0.001};
    case 0x00D:
      return {0.5, 0.1, 0.001};
    case 0x027:
      return {0.01, 0.001, 0.000001};
    case 0x023:
    case 0x024:
    case 0x02B:
      return {1.0 / 127.0, 1.0 / 32767.0, 1.0 / 2147483647.0};
    default:
      return {1.0, 1.0, 1.0};
  }
}

// Returns the number of bytes of a value of that type.
std::size_t moteus_width(unsigned type) {
  return type == 0 ? 1 : type == 1 ? 2 : 4;
}

// Returns the lowest integer of `width` bytes.
double lowest_of(std::size_t width) {
  return -std::ldexp(1.0, static_cast<int>(8 * width) - 1);
}

// Takes a value off `rest`; the caller has checked that it is there. The lowest integer stands for
// NaN in registers with a scale.
double take_value(std::span<const std::byte>& rest, unsigned type, unsigned at) {
  const std::size_t width = moteus_width(type);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < width; ++i) {
    bits |= std::to_integer<std::uint32_t>(rest[i]) << (8U * i);
  }
  rest = rest.subspan(width);
  if (type == kFloatType) {
    return static_cast<double>(std::bit_cast<float>(bits));
  }
  const auto shift = static_cast<unsigned>(32 - 8 * width);
  const double raw = static_cast<double>(std::bit_cast<std::int32_t>(bits << shift) >> shift);
  const bool plain = moteus_steps(at)[0] == 1.0 && moteus_steps(at)[2] == 1.0;
  return raw == lowest_of(width) && !plain ? std::numeric_limits<double>::quiet_NaN()
                                           : raw * moteus_steps(at)[type];
}

// Appends a value in the given type; what is not finite becomes the lowest integer.
void put_value(std::vector<std::uint8_t>& bytes, unsigned type, unsigned at, double value) {
  const std::size_t width = moteus_width(type);
  std::uint32_t bits = 0;
  if (type == kFloatType) {
    bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  } else {
    const double lowest = lowest_of(width);
    const double raw = std::isfinite(value) ? std::clamp(std::trunc(value / moteus_steps(at)[type]),
                                                         lowest + 1.0, -lowest - 1.0)
                                            : lowest;
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(raw));
  }
  for (std::size_t i = 0; i < width; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(bits >> (8U * i)));
  }
}

// A varuint has seven bits a byte, the lowest first; a set top bit means that more follow.
void put_varuint(std::vector<std::uint8_t>& bytes, unsigned value) {
  while (value >= 0x80U) {
    bytes.push_back(static_cast<std::uint8_t>(0x80U | (value & 0x7FU)));
    value >>= 7U;
  }
  bytes.push_back(static_cast<std::uint8_t>(value));
}

// Takes a varuint off `rest`; returns false if the bytes end before it does.
bool take_varuint(std::span<const std::byte>& rest, unsigned& value) {
  value = 0;
  for (unsigned shift = 0; shift < 32 && !rest.empty(); shift += 7) {
    const auto byte = std::to_integer<unsigned>(rest.front());
    rest = rest.subspan(1);
    value |= (byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

MoteusEmulator::MoteusEmulator(hal::CanBus& bus, std::uint32_t seed,
                               const MoteusEmulatorConfig& config)
    : CanEmulator(bus, seed), config_(config) {}

void MoteusEmulator::take(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  const bool is_mine = (frame.id & 0x7FU) == config_.servo_id && (frame.id & 0x80U) == 0 &&
                       (frame.id >> 16U) == config_.prefix && !frame.remote;
  if (!is_mine) {
    return;
  }
  written_ = command_;
  has_mode_ = false;
  answer_.clear();
  read_subframes({frame.data.data(), frame.length});
  if ((frame.id & 0x8000U) != 0) {
    reply(now_ns, frame);
  }
  if (has_mode_) {
    obey(now_ns);
  }
}

void MoteusEmulator::read_subframes(Bytes payload) {
  unsigned header = 0;
  while (take_varuint(payload, header)) {
    // 0x50 is padding. Below 0x20 the header has the type in bits 2 and 3 and the count in bits 0
    // and 1.
    if (header == 0x50U) {
      continue;
    }
    if (header >= 0x20U) {
      return;
    }
    const unsigned type = (header >> 2U) & 3U;
    unsigned count = header & 3U;
    if (count == 0 && !take_varuint(payload, count)) {
      return;
    }
    if (!(header < 0x10U ? do_write(type, count, payload) : do_read(type, count, payload))) {
      return;
    }
  }
}

bool MoteusEmulator::do_write(unsigned type, unsigned count, Bytes& rest) {
  unsigned at = 0;
  if (!take_varuint(rest, at)) {
    return false;
  }
  for (unsigned i = 0; i < count; ++i, ++at) {
    if (rest.size() < moteus_width(type)) {
      return false;
    }
    if (!write_register(at, take_value(rest, type, at))) {
      // 0x30: a write error, with the register and an error number.
      answer_.push_back(0x30);
      put_varuint(answer_, at);
      put_varuint(answer_, 1);
    }
  }
  return true;
}

bool MoteusEmulator::do_read(unsigned type, unsigned count, Bytes& rest) {
  unsigned first = 0;
  if (!take_varuint(rest, first)) {
    return false;
  }
  std::vector<std::uint8_t> values;
  for (unsigned i = 0; i < count && values.size() < hal::kMaxCanFdBytes; ++i) {
    double value = 0.0;
    if (!read_register(first + i, value)) {
      // 0x31: a read error.
      answer_.push_back(0x31);
      put_varuint(answer_, first + i);
      put_varuint(answer_, 1);
      return true;
    }
    put_value(values, type, first + i, value);
  }
  if (count <= 3) {
    answer_.push_back(static_cast<std::uint8_t>(0x20U + 4U * type + count));
  } else {
    answer_.push_back(static_cast<std::uint8_t>(0x20U + 4U * type));
    put_varuint(answer_, count);
  }
  put_varuint(answer_, first);
  answer_.insert(answer_.end(), values.begin(), values.end());
  return true;
}

bool MoteusEmulator::write_register(unsigned at, double value) {
  switch (at) {
    case 0x000:
      if (const bool exists = value >= 0.0 && value <= kMoteusLastMode; !exists) {
        return false;
      }
      written_ = {};
      written_.mode = static_cast<int>(value);
      has_mode_ = true;
      return true;
    case 0x020:
      written_.position_rev = value;
      return true;
    case 0x021:
      written_.velocity_rev_per_s = value;
      return true;
    case 0x022:
      written_.feedforward_Nm = value;
      return true;
    case 0x023:
      written_.kp_scale = value;
      return true;
    case 0x024:
      written_.kd_scale = value;
      return true;
    case 0x025:
      written_.max_torque_Nm = value;
      return true;
    case 0x027:
      written_.timeout_s = value;
      return true;
    case 0x026:  // stop position, limits, fixed voltage, integral: there, but not faked
    case 0x028:
    case 0x029:
    case 0x02A:
    case 0x02B:
      return true;
    default:
      return false;
  }
}

bool MoteusEmulator::read_register(unsigned at, double& value) const {
  switch (at) {
    case 0x000:
      value = mode_;
      return true;
    case 0x001:
      value = position_lost_ ? std::numeric_limits<double>::quiet_NaN()
                             : kMoteusRevPerRad * (shaft().position_rad - zero_rad_);
      return true;
    case 0x002:
      value = kMoteusRevPerRad * shaft().velocity_rad_per_s;
      return true;
    case 0x003:
      value = shaft().torque_Nm;
      return true;
    case 0x00C:
      value = config_.output_encoder ? 2 : 1;
      return true;
    case 0x00D:
      value = kMoteusVoltage_V;
      return true;
    case 0x00E:
      value = kMoteusTemperature_C;
      return true;
    case 0x00F:
      value = fault_ != 0 ? fault_ : limit_;
      return true;
    case 0x102:
      value = 5.0;
      return true;
    default:
      return false;
  }
}

// Carries out a frame that writes the mode. The reply to it was made before and shows the earlier
// state, as that of a servo does.
void MoteusEmulator::obey(hal::TimeNs now_ns) {
  if (written_.mode == kMoteusStopped) {
    command_ = written_;
    mode_ = kMoteusStopped;
    mode_since_ns_ = now_ns;
    fault_ = 0;
    return;
  }
  if (mode_ == kMoteusFault || mode_ == kMoteusTimeout) {
    return;
  }
  if (mode_ == kMoteusStopped) {
    mode_ = kMoteusEnabling;
    mode_since_ns_ = now_ns;
    held_rev_ = kMoteusRevPerRad * shaft().position_rad;
  }
  if (mode_ > kMoteusCalibrated) {
    mode_ = written_.mode;
  }
  command_ = written_;
  commanded_ns_ = now_ns;
}

void MoteusEmulator::raise_fault(int code) {
  fault_ = code;
  mode_ = kMoteusFault;
}

void MoteusEmulator::limit(int code) {
  limit_ = code;
}

void MoteusEmulator::lose_position(bool is_lost) {
  position_lost_ = is_lost;
}

// After power-up the rotor's encoder tells the angle within a turn of the rotor, and the output's
// encoder within a turn of the output; whole turns are lost.
void MoteusEmulator::boot() {
  mode_ = kMoteusStopped;
  fault_ = 0;
  command_ = {};
  const double turn_rad = (config_.output_encoder ? 1.0 : 1.0 / config_.gear) / kMoteusRevPerRad;
  zero_rad_ = turn_rad * std::round(shaft().position_rad / turn_rad);
}

void MoteusEmulator::advance(hal::TimeNs now_ns, bool erroring) {
  if (has_run_ && now_ns - ran_ns_ >= kMoteusPowerLoss_ns) {
    boot();
  }
  has_run_ = true;
  ran_ns_ = now_ns;
  if (erroring && !was_erroring_) {
    raise_fault(kMotorDriverFaultCode);
  }
  was_erroring_ = erroring;
  proceed(now_ns);
  set_torque();
}

void MoteusEmulator::proceed(hal::TimeNs now_ns) {
  const double since_s = 1e-9 * static_cast<double>(now_ns - mode_since_ns_);
  if (mode_ >= kMoteusEnabling && mode_ <= kMoteusCalibrated) {
    constexpr int kSteps = kMoteusCalibrated - kMoteusEnabling + 1;
    const int step = static_cast<int>(kSteps * since_s / config_.start_s);
    mode_ = step < kSteps ? kMoteusEnabling + step : command_.mode;
  }
  const double silent_s = 1e-9 * static_cast<double>(now_ns - commanded_ns_);
  const double timeout_s =
      command_.timeout_s == 0.0 ? config_.default_timeout_s : command_.timeout_s;
  // A time-out of NaN never expires.
  if (config_.has_watchdog && mode_ == kMoteusPosition && silent_s > timeout_s) {
    mode_ = kMoteusTimeout;
  }
}

// The control law of moteus, of position p, velocity v and scales s, with the torque limited:
//
//   tau = s_p k_p (p_goal - p) + s_d k_d (v_goal - v) + feedforward
void MoteusEmulator::set_torque() {
  const double position_rev = kMoteusRevPerRad * shaft().position_rad;
  const double velocity_rev_per_s = kMoteusRevPerRad * shaft().velocity_rad_per_s;
  const bool damps = mode_ == kMoteusZeroVelocity ||
                     (mode_ == kMoteusTimeout && config_.timeout_mode == kMoteusZeroVelocity);
  if (damps) {
    shaft().torque_Nm = std::clamp(-config_.kd_Nm_s_per_rev * velocity_rev_per_s,
                                   -config_.timeout_max_torque_Nm, config_.timeout_max_torque_Nm);
    return;
  }
  if (mode_ != kMoteusPosition) {
    shaft().torque_Nm = 0.0;
    return;
  }
  const double goal_rev = std::isnan(command_.position_rev) ? held_rev_ : command_.position_rev;
  const double wanted_Nm = command_.kp_scale * config_.kp_Nm_per_rev * (goal_rev - position_rev) +
                           command_.kd_scale * config_.kd_Nm_s_per_rev *
                               (command_.velocity_rev_per_s - velocity_rev_per_s) +
                           command_.feedforward_Nm;
  const double most_Nm = std::isnan(command_.max_torque_Nm)
                             ? config_.max_torque_Nm
                             : std::min(command_.max_torque_Nm, config_.max_torque_Nm);
  shaft().torque_Nm = std::clamp(wanted_Nm, -most_Nm, most_Nm);
}

void MoteusEmulator::reply(hal::TimeNs now_ns, const hal::CanFrame& query) {
  // The payload lengths that CAN FD has; the rest of a frame is padding.
  constexpr std::array<std::size_t, 16> kLengths{0, 1,  2,  3,  4,  5,  6,  7,
                                                 8, 12, 16, 20, 24, 32, 48, 64};
  const std::uint32_t host = (query.id >> 8U) & 0x7FU;
  const std::uint32_t id =
      (std::uint32_t{config_.prefix} << 16U) | (std::uint32_t{config_.servo_id} << 8U) | host;
  answer_.resize(std::min(answer_.size(), kLengths.back()));
  answer_.resize(*std::ranges::lower_bound(kLengths, answer_.size()), 0x50);
  hal::CanFrame frame{.id = id, .extended = id >= 0x7FFU};
  frame.fd = query.fd || answer_.size() > hal::kMaxCanBytes;
  frame.bit_rate_switch = query.bit_rate_switch;
  frame.length = static_cast<std::uint8_t>(answer_.size());
  std::ranges::transform(answer_, frame.data.begin(),
                         [](std::uint8_t byte) { return std::byte{byte}; });
  send(now_ns, frame);
}

}  // namespace tactus::host
