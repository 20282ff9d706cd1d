#include "firmware/device_file/can_identifiers.h"

#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "drivers/cia402_can/canopen.h"

namespace tactus::firmware {

namespace {

// The identifiers that one drive sends, obeys or listens to.
class Identifiers {
 public:
  void add(std::uint32_t id, bool extended) {
    if (count_ < ids_.size()) {
      ids_[count_] = {id, extended};
      ++count_;
    }
  }
  [[nodiscard]] std::span<const CanIdentifier> all() const { return {ids_.data(), count_}; }

 private:
  std::array<CanIdentifier, 72> ids_{};
  std::size_t count_ = 0;
};

void collect(const drivers::ODriveConfig& drive, Identifiers& ids) {
  constexpr std::uint32_t kCommands = 32;
  for (std::uint32_t command = 0; command < kCommands; ++command) {
    ids.add(drive.node_id * kCommands + command, false);
  }
}

// Collects NMT and SYNC as well, which all drives of the bus share.
void collect(const drivers::Cia402Config& drive, Identifiers& ids) {
  namespace canopen = drivers::canopen;
  for (const std::uint32_t service :
       {canopen::kEmergency, canopen::kTransmitPdo1, canopen::kReceivePdo1, canopen::kTransmitPdo2,
        canopen::kSdoAnswer, canopen::kSdoRequest, canopen::kHeartbeat}) {
    ids.add(service + drive.node, false);
  }
  ids.add(canopen::kNmt, false);
  ids.add(canopen::kSync, false);
  ids.add(canopen::kHeartbeat + static_cast<std::uint32_t>(drivers::heartbeat_node(drive)), false);
}

void collect(const drivers::VescConfig& drive, Identifiers& ids) {
  constexpr std::uint32_t kPackets = 64;
  constexpr std::uint32_t kShortBuffer = 8;
  for (std::uint32_t packet = 0; packet < kPackets; ++packet) {
    ids.add(packet << 8U | drive.vesc_id, true);
  }
  ids.add(kShortBuffer << 8U | drive.host_id, true);
}

// A servo takes and sends short identifiers in standard and extended frames.
void collect(const drivers::MoteusConfig& drive, Identifiers& ids) {
  constexpr std::uint32_t kWantsAnswer = 0x8000;
  constexpr std::uint32_t kShortest = 0x800;
  const std::uint32_t prefix = std::uint32_t{drive.prefix} << 16U;
  const std::uint32_t command = prefix | std::uint32_t{drive.host_id} << 8U | drive.servo_id;
  const std::uint32_t answer = prefix | std::uint32_t{drive.servo_id} << 8U | drive.host_id;
  for (const std::uint32_t id : {command, command | kWantsAnswer, answer}) {
    ids.add(id, true);
    if (id < kShortest) {
      ids.add(id, false);
    }
  }
}

void collect(const BoardAxis& /*board*/, Identifiers& /*ids*/) {}
void collect(const drivers::GpioAxisConfig& /*axis*/, Identifiers& /*ids*/) {}

bool same(const drivers::ODriveConfig& one, const drivers::ODriveConfig& other) {
  return one.node_id == other.node_id;
}
bool same(const drivers::Cia402Config& one, const drivers::Cia402Config& other) {
  return one.node == other.node;
}
bool same(const drivers::VescConfig& one, const drivers::VescConfig& other) {
  return one.vesc_id == other.vesc_id || one.vesc_id == other.host_id ||
         one.host_id == other.vesc_id;
}
bool same(const drivers::MoteusConfig& one, const drivers::MoteusConfig& other) {
  return one.prefix == other.prefix &&
         (one.servo_id == other.servo_id || one.servo_id == other.host_id ||
          one.host_id == other.servo_id);
}
bool same(const BoardAxis& /*one*/, const BoardAxis& /*other*/) {
  return false;
}
bool same(const drivers::GpioAxisConfig& /*one*/, const drivers::GpioAxisConfig& /*other*/) {
  return false;
}

}  // namespace

std::string_view number_key(const AxisConfig& axis) {
  if (std::holds_alternative<drivers::ODriveConfig>(axis.drive)) {
    return "node_id";
  }
  if (std::holds_alternative<drivers::MoteusConfig>(axis.drive)) {
    return "servo_id";
  }
  if (std::holds_alternative<drivers::Cia402Config>(axis.drive)) {
    return "node";
  }
  return std::holds_alternative<drivers::VescConfig>(axis.drive) ? "vesc_id" : "";
}

bool have_same_number(const AxisConfig& one, const AxisConfig& other) {
  return std::visit(
      [&other](const auto& drive) {
        const auto* also = std::get_if<std::remove_cvref_t<decltype(drive)>>(&other.drive);
        return also != nullptr && same(drive, *also);
      },
      one.drive);
}

std::optional<CanIdentifier> shared_identifier(const AxisConfig& one, const AxisConfig& other) {
  if (one.drive.index() == other.drive.index()) {
    return std::nullopt;
  }
  Identifiers ids;
  Identifiers others;
  std::visit([&ids](const auto& drive) { collect(drive, ids); }, one.drive);
  std::visit([&others](const auto& drive) { collect(drive, others); }, other.drive);
  for (const CanIdentifier& id : ids.all()) {
    if (std::ranges::find(others.all(), id) != others.all().end()) {
      return id;
    }
  }
  return std::nullopt;
}

}  // namespace tactus::firmware
