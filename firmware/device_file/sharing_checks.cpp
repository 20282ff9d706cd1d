// Checks that nothing of a device is used twice, and that every name is valid for the system.
#include <algorithm>
#include <array>
#include <optional>
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

// Returns the key in which two connections agree but must differ, or an empty text.
std::string_view shared_key(const ConnectionConfig& one, const ConnectionConfig& other) {
  return drivers::visit_connection(
      one.line, [&other](const auto& kind, const auto& line) -> std::string_view {
        const auto* also = std::get_if<std::remove_cvref_t<decltype(line)>>(&other.line);
        return also == nullptr ? std::string_view{} : kind.shared_key(line, *also);
      });
}

Verdict check_connections(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.connection_count; ++i) {
    const auto checked = drivers::visit_connection(
        device.connections[i].line,
        [](const auto& kind, const auto& line) { return kind.check(line); });
    if (!checked) {
      return refuse(Place::connection, i, checked.error().field, checked.error().rule);
    }
    for (const ConnectionConfig& other : std::span(device.connections).first(i)) {
      const std::string_view key = shared_key(device.connections[i], other);
      if (!key.empty()) {
        also_of(words, "connection", other.name)
            .add(drivers::visit_connection(
                device.connections[i].line,
                [](const auto& kind, const auto& /*line*/) { return kind.sharing_advice; }));
        return refuse(Place::connection, i, key, words.view());
      }
    }
  }
  return {};
}

std::optional<std::size_t> number_on_board(const AxisConfig& axis) {
  return drivers::visit_drive(
      axis.drive, [](const auto& driver, const auto& drive) -> std::optional<std::size_t> {
        return driver.number_on_board == nullptr ? std::nullopt
                                                 : std::optional(driver.number_on_board(drive));
      });
}

Verdict check_board_numbers(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.axis_count; ++i) {
    const AxisConfig& axis = device.axes[i];
    const auto number = number_on_board(axis);
    for (const AxisConfig& other : std::span(device.axes).first(i)) {
      if (number && other.connection == axis.connection && number_on_board(other) == number) {
        also_of(words, "axis", other.name).add("each of a board's axes has a number of its own");
        return refuse(Place::axis, i, "number", words.view());
      }
    }
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
      if (const Verdict verdict = check_can_pair(device.axes[i], i, device.axes[k], {}, words);
          !verdict) {
        return verdict;
      }
    }
  }
  return {};
}

}  // namespace

Verdict check_can_pair(const AxisConfig& axis, std::size_t index, const AxisConfig& other,
                       std::string_view of_other, Words& words) {
  const std::string_view key = number_key(axis);
  if (have_same_number(axis, other)) {
    words.clear();
    words.add("is also that of axis \"")
        .add(other.name)
        .add("\"")
        .add(of_other)
        .add(
            "; both would obey each other's torques: give each drive on a bus a number of its own, "
            "in the drive and here");
    return refuse(Place::axis, index, key, words.view());
  }
  if (const auto shared = shared_identifier(axis, other)) {
    words.clear();
    words.add("gives it the CAN identifier 0x")
        .add(shared->id, 16U)
        .add(shared->extended ? " (29 bits)" : " (11 bits)")
        .add(", which axis \"")
        .add(other.name)
        .add("\"")
        .add(of_other)
        .add(" uses too; choose other numbers, or give one of them a bus of its own");
    return refuse(Place::axis, index, key, words.view());
  }
  return {};
}

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
