#include "firmware/device_file/bus_load.h"

#include <span>
#include <variant>

namespace tactus::firmware {

namespace {

enum class Identifier : bool { standard, extended };

// Returns the bits of a classic frame, with the space behind it. The part up to the end of the
// checksum may have a stuff bit after each four bits (the first after five).
double classic_bits(Identifier identifier, int bytes) {
  const int stuffed = (identifier == Identifier::standard ? 34 : 54) + 8 * bytes;
  constexpr int kNeverStuffed = 13;
  const int stuff_bits = (stuffed - 1) / 4;
  return stuffed + kNeverStuffed + stuff_bits;
}

// Returns the seconds of a CAN FD frame. Its identifier has the nominal rate and its payload the
// data rate. Both parts may have a stuff bit after each four bits; the checksum has them at fixed
// places.
double fd_seconds(const CanConnection& can, bool switches_rate, Identifier identifier, int bytes) {
  const int head = identifier == Identifier::standard ? 17 : 36;
  constexpr int kTail = 13;
  constexpr int kLongestShortPayload = 16;
  const int payload = 5 + 8 * bytes;
  const int checksum = bytes <= kLongestShortPayload ? 27 : 32;
  const int head_stuff_bits = head / 4;
  const int payload_stuff_bits = payload / 4;
  const double nominal = head + head_stuff_bits + kTail;
  const double fast = payload + payload_stuff_bits + checksum;
  return nominal / can.bit_rate + fast / (switches_rate ? can.data_bit_rate : can.bit_rate);
}

constexpr double kTick_s = 0.001;  // fastest period of a drive that sends by its own clock

// Returns bits a second. An estimate has eight bytes, a torque four.
double odrive_bits(const drivers::ODriveConfig& drive, double rate_hz) {
  constexpr double kHeartbeat_s = 0.01;  // the setting in README.md
  const double message = classic_bits(Identifier::standard, 8);
  const double question = classic_bits(Identifier::standard, 0);
  const bool asks = drive.estimates == drivers::ODriveEstimates::requested;
  double bits = rate_hz * classic_bits(Identifier::standard, 4) + message / kHeartbeat_s;
  bits += asks ? rate_hz * (question + message) : message / kTick_s;
  for (const double period_s : {drive.poll_period_s, drive.torque_period_s}) {
    bits += period_s > 0.0 ? (question + message) / period_s : 0.0;
  }
  return bits;
}

double vesc_bits(const drivers::VescConfig& drive, double rate_hz) {
  const double message = classic_bits(Identifier::extended, 8);
  const double status = message * (drive.offers_position ? 3.0 : 1.0) / drive.status_period_s;
  return rate_hz * classic_bits(Identifier::extended, 6) + status +
         2.0 * message / drive.poll_period_s;
}

// Returns bits a second. Each SYNC has PDOs with controlword and torque, with statusword, position
// and torque, and, if asked for, with velocity and mode. The drive sends heartbeats, and the host
// sends some for it alone.
double cia402_bits(const drivers::Cia402Config& drive, double rate_hz) {
  constexpr double kMilliseconds = 1000.0;
  constexpr double kHeartbeatsPerWatchdog = 4.0;
  const double heartbeat = classic_bits(Identifier::standard, 1);
  double tick = classic_bits(Identifier::standard, 4) + classic_bits(Identifier::standard, 8);
  tick += drive.velocity_unit_rad_per_s > 0.0 ? classic_bits(Identifier::standard, 5) : 0.0;
  tick += drive.leads_bus ? classic_bits(Identifier::standard, 0) : 0.0;
  const double host = kHeartbeatsPerWatchdog * kMilliseconds / drive.watchdog_ms;
  return rate_hz * tick + heartbeat * (kMilliseconds / drive.drive_heartbeat_ms + host);
}

double moteus_share(const CanConnection& can, const drivers::MoteusConfig& drive, double rate_hz) {
  constexpr int kTorqueBytes = 48;
  constexpr int kAnswerBytes = 32;
  constexpr int kQueryBytes = 8;
  const auto seconds = [&](int bytes) {
    return fd_seconds(can, drive.bit_rate_switch, Identifier::extended, bytes);
  };
  const bool asks = drive.query == drivers::MoteusQuery::before_command;
  return rate_hz *
         (seconds(kTorqueBytes) + seconds(kAnswerBytes) + (asks ? seconds(kQueryBytes) : 0.0));
}

double share_of(const AxisConfig& axis, const CanConnection& can, double rate_hz) {
  if (const auto* odrive = std::get_if<drivers::ODriveConfig>(&axis.drive)) {
    return odrive_bits(*odrive, rate_hz) / can.bit_rate;
  }
  if (const auto* vesc = std::get_if<drivers::VescConfig>(&axis.drive)) {
    return vesc_bits(*vesc, rate_hz) / can.bit_rate;
  }
  if (const auto* cia402 = std::get_if<drivers::Cia402Config>(&axis.drive)) {
    return cia402_bits(*cia402, rate_hz) / can.bit_rate;
  }
  const auto* moteus = std::get_if<drivers::MoteusConfig>(&axis.drive);
  return moteus == nullptr ? 0.0 : moteus_share(can, *moteus, rate_hz);
}

}  // namespace

double bus_load(const DeviceConfig& config, std::size_t connection) {
  const auto* can = std::get_if<CanConnection>(&config.connections[connection].line);
  if (can == nullptr) {
    return 0.0;
  }
  double load = 0.0;
  for (const AxisConfig& axis : std::span(config.axes).first(config.axis_count)) {
    if (axis.connection == connection) {
      load += share_of(axis, *can, config.controller.rate_hz);
    }
  }
  return load;
}

}  // namespace tactus::firmware
