#include "firmware/device_file/together_checks.h"

#include <string_view>
#include <type_traits>
#include <variant>

#include "firmware/device_file/bus_load.h"
#include "firmware/device_file/bus_settings.h"
#include "firmware/device_file/can_identifiers.h"

namespace tactus::firmware {

namespace {

using Devices = std::span<const DeviceConfig* const>;

// Adds: of device 2 ("left").
Words& add_device(Words& words, const DeviceConfig& device, std::size_t number) {
  return words.add(" of device ")
      .add(static_cast<std::uint32_t>(number + 1))
      .add(" (\"")
      .add(device.name)
      .add("\")");
}

Verdict refuse_connection(std::size_t index, std::string_view key, const Words& words) {
  return std::unexpected(Refusal{Place::connection, index, key, words.view()});
}

// Two connections, one of each of two devices.
struct ConnectionPair {
  const DeviceConfig& device;
  std::size_t index;
  const DeviceConfig& other_device;
  std::size_t other_number;
  std::size_t other_index;

  [[nodiscard]] const ConnectionConfig& one() const { return device.connections[index]; }
  [[nodiscard]] const ConnectionConfig& other() const {
    return other_device.connections[other_index];
  }
};

// Checks the drives and the settings of a CAN bus that two devices share.
Verdict check_shared_bus(const ConnectionPair& pair, const drivers::CanConnection& can,
                         const drivers::CanConnection& other_can, Words& words) {
  if (can.bit_rate != other_can.bit_rate || can.data_bit_rate != other_can.data_bit_rate) {
    words.clear();
    words.add("is not that of connection \"").add(pair.other().name).add("\"");
    add_device(words, pair.other_device, pair.other_number)
        .add(" on the same interface; a bus has one rate: write the same in both");
    return refuse_connection(
        pair.index, can.bit_rate != other_can.bit_rate ? "bit_rate" : "data_bit_rate", words);
  }
  Words of_other;
  add_device(of_other, pair.other_device, pair.other_number);
  for (std::size_t i = 0; i < pair.device.axis_count; ++i) {
    const AxisConfig& axis = pair.device.axes[i];
    if (axis.connection != pair.index) {
      continue;
    }
    for (const AxisConfig& other :
         std::span(pair.other_device.axes).first(pair.other_device.axis_count)) {
      if (other.connection != pair.other_index) {
        continue;
      }
      if (const Verdict verdict = check_can_pair(axis, i, other, of_other.view(), words);
          !verdict) {
        return verdict;
      }
    }
  }
  return {};
}

Verdict check_pair(const ConnectionPair& pair, Words& words) {
  return drivers::visit_connection(
      pair.one().line, [&](const auto& kind, const auto& line) -> Verdict {
        using Line = std::remove_cvref_t<decltype(line)>;
        const auto* const also = std::get_if<Line>(&pair.other().line);
        const std::string_view key =
            also == nullptr ? std::string_view{} : kind.shared_key(line, *also);
        if (key.empty()) {
          return {};
        }
        if constexpr (std::is_same_v<Line, drivers::CanConnection>) {
          return check_shared_bus(pair, line, *also, words);
        } else {
          words.clear();
          words.add("is also that of connection \"").add(pair.other().name).add("\"");
          add_device(words, pair.other_device, pair.other_number)
              .add("; ")
              .add(kind.sharing_advice);
          return refuse_connection(pair.index, key, words);
        }
      });
}

Verdict check_two(const DeviceConfig& device, const DeviceConfig& other, std::size_t other_number,
                  Words& words) {
  for (std::size_t i = 0; i < device.connection_count; ++i) {
    for (std::size_t k = 0; k < other.connection_count; ++k) {
      const Verdict verdict = check_pair({device, i, other, other_number, k}, words);
      if (!verdict) {
        return verdict;
      }
    }
  }
  return {};
}

// Returns true if the connection is on the CAN interface.
bool is_on(const DeviceConfig& device, std::size_t connection, std::string_view interface) {
  const auto* const can = std::get_if<drivers::CanConnection>(&device.connections[connection].line);
  return can != nullptr && can->interface == interface;
}

// Returns the share of the bus' time that the frames of all devices take.
double load_of_all(Devices devices, std::string_view interface) {
  double load = 0.0;
  for (const DeviceConfig* const device : devices) {
    for (std::size_t i = 0; i < device->connection_count; ++i) {
      load += is_on(*device, i, interface) ? bus_load(*device, i) : 0.0;
    }
  }
  return load;
}

// Checks a CAN connection of the last device with everything that the bus carries.
Verdict check_whole_bus(Devices devices, std::size_t connection, const drivers::CanConnection& can,
                        Words& words) {
  const drivers::Checked checked =
      check_bus_settings(devices, [&can](const DeviceConfig& device, std::size_t index) {
        return is_on(device, index, can.interface);
      });
  if (!checked) {
    words.clear();
    words.add("cannot be shared with the devices before: ").add(checked.error().rule);
    return refuse_connection(connection, "interface", words);
  }
  const double load = load_of_all(devices, can.interface);
  if (load > kMaxBusLoad) {
    constexpr double kPercent = 100.0;
    words.clear();
    words.add("would be ")
        .add(kPercent * load, 0)
        .add(" % full with the frames of all devices, more than the 90 % that it can carry in ")
        .add(
            "time; write a lower rate_hz, use a faster bit_rate, or give a device a bus of its "
            "own");
    return refuse_connection(connection, "interface", words);
  }
  return {};
}

Verdict check_buses(Devices devices, Words& words) {
  const DeviceConfig& last = *devices.back();
  for (std::size_t i = 0; i < last.connection_count; ++i) {
    if (const auto* const can = std::get_if<drivers::CanConnection>(&last.connections[i].line)) {
      if (const Verdict verdict = check_whole_bus(devices, i, *can, words); !verdict) {
        return verdict;
      }
    }
  }
  return {};
}

}  // namespace

std::expected<void, TogetherRefusal> check_together(Devices devices, Words& words) {
  for (std::size_t i = 1; i < devices.size(); ++i) {
    Verdict verdict;
    for (std::size_t k = 0; k < i && verdict; ++k) {
      verdict = check_two(*devices[i], *devices[k], k, words);
    }
    if (verdict) {
      verdict = check_buses(devices.first(i + 1), words);
    }
    if (!verdict) {
      return std::unexpected(TogetherRefusal{.device = i, .refusal = verdict.error()});
    }
  }
  return {};
}

}  // namespace tactus::firmware
