// The registration of a driver: everything that the rest of the program must know of it. It is one
// constant in the driver's folder, and registered_drivers.h lists it. Reading device.toml, the
// checks of a whole device, advice, the doctor, and the boards of tactusd follow from it.
//
// Functions that a registration leaves out are null. None of them is real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "drivers/common/can_identifiers.h"
#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"
#include "drivers/common/words.h"

namespace tactus::drivers {

// The extent to which an axis' encoder knows its position after power-up.
enum class EncoderKind : std::uint8_t {
  incremental,    // not at all: it counts from where it was
  absolute_turn,  // within one turn of its shaft
  absolute,       // over all turns, unless EncoderFacts::absolute_is_one_turn
};
constexpr auto setting_words(EncoderKind /*of*/) {
  return std::to_array<Word<EncoderKind>>({{"incremental", EncoderKind::incremental},
                                           {"absolute_turn", EncoderKind::absolute_turn},
                                           {"absolute", EncoderKind::absolute}});
}

// The encoders that the driver's axes can have.
struct EncoderFacts {
  bool may_be_absolute = false;
  bool absolute_is_one_turn = false;  // EncoderKind::absolute, too, is within one turn
  // The lower end of the turn in which an absolute encoder reads after power-up, rad at its shaft,
  // if the axis does not say it.
  double turn_begins_rad = 0.0;
};

// The use of an axis by the controller.
struct AxisUse {
  double rate_hz = 0.0;     // of the ticks
  bool is_encoder = false;  // a joint takes its position from the axis
};

// A line of a GPIO chip that an axis uses.
struct UsedLine {
  std::string_view key;  // in device.toml
  std::optional<std::uint32_t> offset;
};
inline constexpr std::size_t kMaxUsedLines = 12;
using UsedLines = std::array<UsedLine, kMaxUsedLines>;  // entries without a key come last

// An advice of `tactus doctor`; empty: there is none.
struct Advice {
  std::string_view what;
  std::string_view remedy;
};

// A drive's share in its CAN bus. A drive on CAN has all but check_bus.
template <class Config, class Connection>
struct CanFacts {
  bool speaks_fd = false;
  std::string_view number_key;  // the key of the drive's number on the bus: "node_id"
  // Returns true if both drives would answer to the same number, or one to that of the other's
  // host.
  bool (*have_same_number)(const Config& one, const Config& other) = nullptr;
  // Adds the identifiers that the drive sends, obeys or listens to.
  void (*claim)(const Config& config, CanIdentifiers& identifiers) = nullptr;
  // Returns the share of the bus' time that the drive's frames take, its own and those to it, with
  // as many stuff bits as possible. can_connection.h has the lengths of frames.
  double (*load)(const Config& config, const Connection& bus, double rate_hz) = nullptr;
  // Checks the settings in which the drives of this kind on one bus must agree.
  Checked (*check_bus)(std::span<const Config> drives) = nullptr;
};

// `ConfigType` holds the settings of one axis and `ConnectionType` those of the [[connection]] that
// carries it. `DriveType` is the CanDrive that is made of a ConfigType, or void for axes of a board
// with a connection of its own.
template <class ConfigType, class ConnectionType, class DriveType = void>
struct Registration {
  using Config = ConfigType;
  using Connection = ConnectionType;
  using Drive = DriveType;

  std::string_view name;  // the driver of an [[axis]] in device.toml
  std::span<const Binding<Config>> (*keys)() = nullptr;
  // Checks every field against its range, and that the fields fit together.
  Checked (*check)(const Config& config, const Connection& connection) = nullptr;

  EncoderFacts encoder;
  // Returns the counts of a turn of the shaft, or 0 if only the drive knows them.
  double (*counts_per_turn)(const Config& config) = nullptr;
  // Takes what the axis says of its encoder, for a drive that must know it.
  void (*take_encoder)(Config& config, EncoderKind encoder) = nullptr;
  // Explains in words why the axis is no encoder ("a drive that reports no position; ..."), or
  // returns an empty text.
  std::string_view (*no_encoder)(const Config& config) = nullptr;

  bool finds_own_reference = false;                   // and no other fits
  bool (*has_index)(const Config& config) = nullptr;  // null: none
  // Returns which references fit, in words. Null: those of any drive with such an encoder.
  std::string_view (*reference_advice)(const Config& config) = nullptr;
  // Tells the board the angle of an axis in its known pose, rad at its shaft.
  void (*stand_at)(Connection& connection, const Config& config, double home_rad) = nullptr;

  // Checks that the drive is as fast as the controller. The error names a key, and its rule may be
  // a view into `words`.
  Checked (*check_rate)(const Config& config, const AxisUse& use, Words& words) = nullptr;

  // Returns the time after which the drive's own watchdog, which the bring-up proves, stops its
  // motor. Null: it has none.
  double (*watchdog_s)(const Config& config) = nullptr;
  Advice watchdog_advice;  // on a watchdog that was proven
  // Returns true if a circuit stops the motor when a line of the axis stands still. Null: an axis
  // has no such line.
  bool (*has_heartbeat)(const Config& config) = nullptr;

  UsedLines (*lines)(const Config& config) = nullptr;  // of the connection's GPIO chip
  // Returns the number of the axis on its board. Null: axes count in the order of the file.
  std::size_t (*number_on_board)(const Config& config) = nullptr;

  CanFacts<Config, Connection> can;
};

// A kind of [[connection]].
template <class ConnectionType>
struct ConnectionRegistration {
  using Connection = ConnectionType;

  std::string_view kind;  // as in kind = "can"
  std::span<const Binding<Connection>> (*keys)() = nullptr;
  // Checks the names by which the system finds the connection, and every range.
  Checked (*check)(const Connection& connection) = nullptr;
  // Returns the key in which two connections agree but must differ, or an empty text.
  std::string_view (*shared_key)(const Connection& one, const Connection& other) = nullptr;
  std::string_view sharing_advice = "put what hangs on both on one connection, or name another";
  // Returns true if the owner accepts that nothing was proven to stop the board's motors. Null: the
  // axes say so.
  bool (*accepts_unproven_watchdog)(const Connection& connection) = nullptr;
  // Returns the label or path of the GPIO chip whose lines its axis uses. A connection with a chip
  // carries one axis.
  std::string_view (*chip)(const Connection& connection) = nullptr;
};

}  // namespace tactus::drivers
