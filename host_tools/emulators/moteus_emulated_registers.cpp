// The registers of an emulated moteus servo, and the subframes that write and read them, encoded by
// hand from the facts about the register protocol.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "host_tools/emulators/moteus_emulator.h"

namespace tactus::host {

namespace {

// The type of a register's value: 0 int8, 1 int16, 2 int32, 3 float.
constexpr unsigned kFloatType = 3;
// The highest mode that register 0x000 takes.
constexpr int kMoteusLastMode = 15;
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
      query_.answer.push_back(0x30);
      put_varuint(query_.answer, at);
      put_varuint(query_.answer, 1);
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
      query_.answer.push_back(0x31);
      put_varuint(query_.answer, first + i);
      put_varuint(query_.answer, 1);
      return true;
    }
    put_value(values, type, first + i, value);
  }
  if (count <= 3) {
    query_.answer.push_back(static_cast<std::uint8_t>(0x20U + 4U * type + count));
  } else {
    query_.answer.push_back(static_cast<std::uint8_t>(0x20U + 4U * type));
    put_varuint(query_.answer, count);
  }
  put_varuint(query_.answer, first);
  query_.answer.insert(query_.answer.end(), values.begin(), values.end());
  return true;
}

bool MoteusEmulator::write_register(unsigned at, double value) {
  switch (at) {
    case 0x000:
      if (const bool exists = value >= 0.0 && value <= kMoteusLastMode; !exists) {
        return false;
      }
      query_.written = {};
      query_.written.mode = static_cast<int>(value);
      query_.has_mode = true;
      return true;
    case 0x020:
      query_.written.position_rev = value;
      return true;
    case 0x021:
      query_.written.velocity_rev_per_s = value;
      return true;
    case 0x022:
      query_.written.feedforward_Nm = value;
      return true;
    case 0x023:
      query_.written.kp_scale = value;
      return true;
    case 0x024:
      query_.written.kd_scale = value;
      return true;
    case 0x025:
      query_.written.max_torque_Nm = value;
      return true;
    case 0x027:
      query_.written.timeout_s = value;
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
      value = sensor_.is_lost ? std::numeric_limits<double>::quiet_NaN()
                              : kRevPerRad * (shaft().position_rad - sensor_.zero_rad);
      return true;
    case 0x002:
      value = kRevPerRad * shaft().velocity_rad_per_s;
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

}  // namespace tactus::host
