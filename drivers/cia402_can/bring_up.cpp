#include "drivers/cia402_can/bring_up.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/cia402_can/drive_profile.h"

namespace tactus::drivers::cia402 {

namespace {

using enum Meaning;

// Bit 31 of a PDO's COB-ID switches the PDO off. Bit 30 of a transmit PDO's forbids remote
// requests.
constexpr std::uint32_t kOff = 0x8000'0000;
constexpr std::uint32_t kNoRemote = 0x4000'0000;

// A PDO is switched off and its mapping emptied before it is changed. Unused PDOs are switched off,
// since a drive's default mapping would only load the bus.
constexpr std::array kSetUpSteps = std::to_array<SdoStep>({
    {{0x1000, 0}, 0, device_type, 0, false, "1000:00 (device type) cannot be read"},
    {{0x1018, 1}, 0, vendor, 0, true, "1018:01 (vendor) cannot be read"},
    {{0x6502, 0}, 0, supported_modes, 0, false, "6502:00 (supported modes) cannot be read"},
    {{0x6076, 0}, 0, rated_torque, 0, true, "6076:00 (rated torque) cannot be read"},

    {{0x1016, 1}, 4, watchdog, 0, false, "1016:01 (watchdog on the host) cannot be set"},
    {{0x1017, 0}, 2, heartbeat_period, 0, false, "1017:00 (heartbeat) cannot be set"},
    {{0x1029, 1},
     1,
     fixed,
     0,
     true,
     "1029:01 (not operational when the host is gone) cannot be set"},
    {{0x6007, 0}, 2, fixed, 1, true, "6007:00 (fault when the host is gone) cannot be set"},
    {{0x605E, 0}, 2, fixed, 0, true, "605E:00 (no torque in a fault) cannot be set"},
    {{0x6072, 0}, 2, torque_limit, 0, false, "6072:00 (torque limit) cannot be set"},
    {{0x60E0, 0}, 2, torque_limit, 0, true, "60E0:00 (positive torque limit) cannot be set"},
    {{0x60E1, 0}, 2, torque_limit, 0, true, "60E1:00 (negative torque limit) cannot be set"},
    {{0x60B2, 0}, 2, fixed, 0, true, "60B2:00 (torque offset) cannot be set to zero"},
    {{0x60C2, 1}, 1, period, 0, true, "60C2:01 (period) cannot be set"},
    {{0x60C2, 2}, 1, period_exponent, 0, true, "60C2:02 (exponent of the period) cannot be set"},

    {{0x1400, 1}, 4, plus_node, kOff | 0x200, false, "1400:01 (RPDO1 off) cannot be set"},
    {{0x1600, 0}, 1, fixed, 0, false, "1600:00 (RPDO1 empty) cannot be set"},
    {{0x1600, 1}, 4, fixed, 0x6040'0010, false, "1600:01 (controlword) cannot be set"},
    {{0x1600, 2}, 4, fixed, 0x6071'0010, false, "1600:02 (target torque) cannot be set"},
    {{0x1600, 0}, 1, fixed, 2, false, "1600:00 (RPDO1 of two) cannot be set"},
    {{0x1400, 2}, 1, receive_type, 0, false, "1400:02 (type of RPDO1) cannot be set"},
    {{0x1400, 1}, 4, plus_node, 0x200, false, "1400:01 (RPDO1 on) cannot be set"},

    {{0x1800, 1},
     4,
     plus_node,
     kOff | kNoRemote | 0x180,
     false,
     "1800:01 (TPDO1 off) cannot be set"},
    {{0x1A00, 0}, 1, fixed, 0, false, "1A00:00 (TPDO1 empty) cannot be set"},
    {{0x1A00, 1}, 4, fixed, 0x6041'0010, false, "1A00:01 (statusword) cannot be set"},
    {{0x1A00, 2}, 4, fixed, 0x6064'0020, false, "1A00:02 (position) cannot be set"},
    {{0x1A00, 3}, 4, fixed, 0x6077'0010, false, "1A00:03 (torque) cannot be set"},
    {{0x1A00, 0}, 1, fixed, 3, false, "1A00:00 (TPDO1 of three) cannot be set"},
    {{0x1800, 2}, 1, fixed, 1, false, "1800:02 (type of TPDO1) cannot be set"},
    {{0x1800, 1}, 4, plus_node, kNoRemote | 0x180, false, "1800:01 (TPDO1 on) cannot be set"},

    {{0x1801, 1},
     4,
     plus_node,
     kOff | kNoRemote | 0x280,
     false,
     "1801:01 (TPDO2 off) cannot be set"},
    {{0x1A01, 0}, 1, fixed, 0, false, "1A01:00 (TPDO2 empty) cannot be set"},
    {{0x1A01, 1}, 4, fixed, 0x606C'0020, false, "1A01:01 (velocity) cannot be set"},
    {{0x1A01, 2}, 4, fixed, 0x6061'0008, false, "1A01:02 (mode) cannot be set"},
    {{0x1A01, 0}, 1, fixed, 2, false, "1A01:00 (TPDO2 of two) cannot be set"},
    {{0x1801, 2}, 1, motion_type, 0, false, "1801:02 (type of TPDO2) cannot be set"},
    {{0x1801, 1}, 4, plus_node, kNoRemote | 0x280, false, "1801:01 (TPDO2 on) cannot be set"},

    {{0x1401, 1}, 4, plus_node, kOff | 0x300, true, "1401:01 (RPDO2 off) cannot be set"},
    {{0x1402, 1}, 4, plus_node, kOff | 0x400, true, "1402:01 (RPDO3 off) cannot be set"},
    {{0x1403, 1}, 4, plus_node, kOff | 0x500, true, "1403:01 (RPDO4 off) cannot be set"},
    {{0x1802, 1},
     4,
     plus_node,
     kOff | kNoRemote | 0x380,
     true,
     "1802:01 (TPDO3 off) cannot be set"},
    {{0x1803, 1},
     4,
     plus_node,
     kOff | kNoRemote | 0x480,
     true,
     "1803:01 (TPDO4 off) cannot be set"},
});

constexpr SdoStep kTorqueModeStep{
    {0x6060, 0}, 1,
    fixed,       kCyclicSynchronousTorque,
    false,       "6060:00 (cyclic synchronous torque mode) cannot be set",
};

constexpr std::uint32_t kAtEverySync = 1;
constexpr std::uint32_t kAtEvery20thSync = 20;  // enough for the mode
constexpr std::uint32_t kOnReceipt = 255;

// Returns true if the period is a whole number of milliseconds. 60C2 holds value * 10^exponent
// seconds, and every drive accepts milliseconds.
bool is_in_ms(double period_s) {
  return std::abs(1e3 * period_s - std::round(1e3 * period_s)) < 1e-6;
}

constexpr double kRatedTorqueAgreement = 0.2;
constexpr double kPerMille = 1000.0;
constexpr double kLargestTorqueUnits = 32767.0;

Trouble judge_rated_torque(std::uint32_t value, const Cia402Config& config, DriveFacts& facts) {
  const double unit_Nm = config.rated_torque_from == RatedTorque::drive_uNm ? 1e-6 : 1e-3;
  const double reported_Nm = unit_Nm * value;
  const double expected_Nm = config.rated_torque_Nm;
  const bool is_configured = config.rated_torque_from == RatedTorque::configured;
  if (!is_configured && value == 0) {
    return {"drive reports a rated torque (6076:00) of zero",
            "set the motor's data in the drive, or rated_torque_from to configured", value};
  }
  if (!is_configured && expected_Nm > 0.0 &&
      std::abs(reported_Nm - expected_Nm) > kRatedTorqueAgreement * expected_Nm) {
    return {"drive's rated torque (6076:00) is not rated_torque_Nm",
            "check its unit (rated_torque_from: mN m or uN m) and the motor's data in the drive",
            value};
  }
  facts.rated_torque_Nm = is_configured ? expected_Nm : reported_Nm;
  const double units = std::floor(kPerMille * config.max_torque_Nm / facts.rated_torque_Nm + 1e-9);
  facts.torque_limit = static_cast<std::int16_t>(std::min(units, kLargestTorqueUnits));
  if (facts.torque_limit == 0) {
    return {"max_torque_Nm is less than 0.1 % of the drive's rated torque (6076:00)",
            "check the unit of the rated torque (rated_torque_from: mN m or uN m)", value};
  }
  return {};
}

}  // namespace

std::span<const SdoStep> set_up_steps() {
  return kSetUpSteps;
}

const SdoStep& torque_mode_step() {
  return kTorqueModeStep;
}

std::uint32_t value_to_write(const SdoStep& step, const Cia402Config& config,
                             const DriveFacts& facts) {
  switch (step.meaning) {
    case plus_node:
      return step.value + config.node;
    case watchdog:
      return static_cast<std::uint32_t>(heartbeat_node(config)) << 16U | config.watchdog_ms;
    case heartbeat_period:
      return config.drive_heartbeat_ms;
    case torque_limit:
      return static_cast<std::uint32_t>(facts.torque_limit);
    case period:
      return static_cast<std::uint32_t>(
          std::lround(config.period_s * (is_in_ms(config.period_s) ? 1e3 : 1e4)));
    case period_exponent:
      return static_cast<std::uint32_t>(is_in_ms(config.period_s) ? -3 : -4);
    case receive_type:
      return config.torque_on_receipt ? kOnReceipt : kAtEverySync;
    case motion_type:
      return config.velocity_unit_rad_per_s > 0.0 ? kAtEverySync : kAtEvery20thSync;
    case fixed:
    case device_type:
    case vendor:
    case supported_modes:
    case rated_torque:
      break;
  }
  return step.value;
}

Trouble judge(const SdoStep& step, std::uint32_t value, const Cia402Config& config,
              DriveFacts& facts) {
  switch (step.meaning) {
    case device_type:
      if ((value & 0xFFFFU) != kDeviceProfile) {
        return {"the device at this node is no CiA 402 drive (1000:00)", "check the node's number",
                value};
      }
      return {};
    case vendor:
      facts.vendor = value;
      return {};
    case supported_modes:
      if ((value & kSupportsTorqueMode) == 0) {
        return {"drive does not offer cyclic synchronous torque (6502:00)",
                "update its firmware or take another drive", value};
      }
      return {};
    case rated_torque:
      return judge_rated_torque(value, config, facts);
    default:
      return {};
  }
}

bool may_go_on_without(const SdoStep& step, std::uint32_t abort_code) {
  return step.may_be_missing &&
         (abort_code == canopen::kAbortNoObject || abort_code == canopen::kAbortNoSubindex ||
          abort_code == canopen::kAbortUnsupported || abort_code == canopen::kAbortReadOnly);
}

}  // namespace tactus::drivers::cia402
