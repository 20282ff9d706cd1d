// Checks that nothing of a device is used twice, and that every name is valid for the system.
#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "firmware/device_file/can_identifiers.h"
#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

namespace {

using Look = Verdict (*)(const DeviceConfig&, Words&);

std::unexpected<Refusal> refuse(Place place, std::size_t index, std::string_view key,
                                std::string_view rule) {
  return std::unexpected(Refusal{place, index, key, rule});
}

// Adds: is also that of axis "drive 0".
Words& also_of(Words& words, std::string_view what, std::string_view name) {
  words.clear();
  return words.add("is also that of ").add(what).add(" \"").add(name).add("\"; ");
}

template <class Part>
Verdict check_names(std::span<const Part> parts, Place place, std::string_view what, Words& words) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!parts[i].name.empty() && parts[i].name == parts[k].name) {
        also_of(words, what, parts[k].name).add("give each a name of its own");
        return refuse(place, i, "name", words.view());
      }
    }
  }
  return {};
}

Verdict check_all_names(const DeviceConfig& device, Words& words) {
  auto verdict = check_names(std::span(device.connections).first(device.connection_count),
                             Place::connection, "another connection,", words);
  if (verdict) {
    verdict = check_names(std::span(device.axes).first(device.axis_count), Place::axis,
                          "another axis,", words);
  }
  if (verdict) {
    verdict = check_names(std::span(device.joints).first(device.joint_count), Place::joint,
                          "another joint,", words);
  }
  return verdict;
}

// A motor or an encoder belongs to one joint, because the joints of a mechanism move independently.
Verdict check_joints(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.joint_count; ++i) {
    const JointConfig& joint = device.joints[i];
    for (const JointConfig& other : std::span(device.joints).first(i)) {
      if (joint.motor == other.motor) {
        also_of(words, "joint", other.name)
            .add("two joints cannot hang on one motor: name an [[axis]] of its own");
        return refuse(Place::joint, i, "motor", words.view());
      }
      if (joint.encoder == other.encoder) {
        also_of(words, "joint", other.name)
            .add("two joints cannot share one encoder: name an [[axis]] of its own");
        return refuse(Place::joint, i, "encoder", words.view());
      }
    }
  }
  return {};
}

constexpr std::string_view kInterfaceRule =
    "must be the name of a network interface, 1 to 15 characters without '/', ':' and white space: "
    "\"can0\"; see ip link show type can";

bool is_interface_name(std::string_view name) {
  constexpr std::size_t kLongest = 15;  // IFNAMSIZ less its end
  return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
         std::ranges::none_of(name, [](char c) {
           return c == '/' || c == ':' || static_cast<unsigned char>(c) <= ' ';
         });
}

// Checks the names by which the system finds a connection.
Verdict check_line(const DeviceConfig& device, std::size_t i) {
  const auto& line = device.connections[i].line;
  const auto is_path = [](std::string_view text) { return text.size() > 1 && text[0] == '/'; };
  if (const auto* can = std::get_if<CanConnection>(&line);
      can != nullptr && !is_interface_name(can->interface)) {
    return refuse(Place::connection, i, "interface", kInterfaceRule);
  }
  if (const auto* haply = std::get_if<HaplyConnection>(&line);
      haply != nullptr && !is_path(haply->port)) {
    return refuse(Place::connection, i, "port",
                  "must be the path of a serial port from the root on, \"/dev/ttyACM0\"");
  }
  if (const auto* gpio = std::get_if<GpioConnection>(&line); gpio != nullptr) {
    if (gpio->chip.empty()) {
      return refuse(Place::connection, i, "chip",
                    "must be the label or the path of a GPIO chip; see gpiodetect");
    }
    if (!is_path(gpio->pwm_folder)) {
      return refuse(Place::connection, i, "pwm_folder",
                    "must be a path from the root on, \"/sys/class/pwm/pwmchip0\"");
    }
  }
  return {};
}

// Returns the key in which two connections agree but must differ, or an empty text.
std::string_view shared_key(const ConnectionConfig& one, const ConnectionConfig& other) {
  if (one.line.index() != other.line.index()) {
    return {};
  }
  if (const auto* can = std::get_if<CanConnection>(&one.line)) {
    return can->interface == std::get<CanConnection>(other.line).interface ? "interface" : "";
  }
  if (const auto* haply = std::get_if<HaplyConnection>(&one.line)) {
    return haply->port == std::get<HaplyConnection>(other.line).port ? "port" : "";
  }
  if (const auto* gpio = std::get_if<GpioConnection>(&one.line)) {
    const auto& also = std::get<GpioConnection>(other.line);
    if (gpio->pwm_folder == also.pwm_folder && gpio->pwm_channel == also.pwm_channel) {
      return "pwm_channel";
    }
    return !gpio->counter.empty() && gpio->counter == also.counter &&
                   gpio->counter_channel == also.counter_channel
               ? "counter"
               : "";
  }
  return "kind";  // of Falcons
}

Verdict check_connections(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.connection_count; ++i) {
    if (const Verdict verdict = check_line(device, i); !verdict) {
      return verdict;
    }
    for (const ConnectionConfig& other : std::span(device.connections).first(i)) {
      const std::string_view key = shared_key(device.connections[i], other);
      if (!key.empty()) {
        also_of(words, "connection", other.name)
            .add(key == "kind" ? "there is room for one Falcon"
                               : "put what hangs on both on one connection, or name another");
        return refuse(Place::connection, i, key, words.view());
      }
    }
  }
  return {};
}

Verdict check_board_numbers(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.axis_count; ++i) {
    const AxisConfig& axis = device.axes[i];
    const auto* board = std::get_if<BoardAxis>(&axis.drive);
    if (board == nullptr) {
      continue;
    }
    const auto* haply = std::get_if<HaplyConnection>(&device.connections[axis.connection].line);
    if (board->number >= (haply != nullptr ? haply->haply.axes : drivers::kFalconArms)) {
      return refuse(Place::axis, i, "number",
                    haply != nullptr ? "must be 0 or 1" : "must be 0, 1 or 2");
    }
    for (const AxisConfig& other : std::span(device.axes).first(i)) {
      const auto* same = std::get_if<BoardAxis>(&other.drive);
      if (same != nullptr && other.connection == axis.connection && same->number == board->number) {
        also_of(words, "axis", other.name).add("each of a board's axes has a number of its own");
        return refuse(Place::axis, i, "number", words.view());
      }
    }
  }
  return {};
}

// Refuses drives on one CAN bus with the same number, or with a common identifier of their frames.
Verdict check_can_pair(const DeviceConfig& device, std::size_t i, std::size_t k, Words& words) {
  const AxisConfig& axis = device.axes[i];
  const AxisConfig& other = device.axes[k];
  const std::string_view key = number_key(axis);
  if (have_same_number(axis, other)) {
    also_of(words, "axis", other.name)
        .add(
            "both would obey each other's torques: give each drive on a bus a number of its own, "
            "in the drive and here");
    return refuse(Place::axis, i, key, words.view());
  }
  if (const auto shared = shared_identifier(axis, other)) {
    words.clear();
    words.add("gives it the CAN identifier 0x")
        .add(shared->id, 16U)
        .add(shared->extended ? " (29 bits)" : " (11 bits)")
        .add(", which axis \"")
        .add(other.name)
        .add("\" uses too; choose other numbers, or give one of them a bus of its own");
    return refuse(Place::axis, i, key, words.view());
  }
  return {};
}

Verdict check_can(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.axis_count; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (device.axes[i].connection != device.axes[k].connection ||
          number_key(device.axes[i]).empty()) {
        continue;
      }
      if (const Verdict verdict = check_can_pair(device, i, k, words); !verdict) {
        return verdict;
      }
    }
  }
  return {};
}

}  // namespace

Verdict check_sharing(const DeviceConfig& device, Words& words) {
  constexpr std::array<Look, 6> kLooks{check_all_names,     check_connections, check_joints,
                                       check_board_numbers, check_pins,        check_can};
  for (const Look look : kLooks) {
    if (const Verdict verdict = look(device, words); !verdict) {
      return verdict;
    }
  }
  return {};
}

}  // namespace tactus::firmware
