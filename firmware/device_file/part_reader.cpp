// Reads the connections, axes and joints of a device.
#include <algorithm>
#include <span>
#include <variant>

#include "firmware/device_file/device_reader.h"

namespace tactus::firmware {

namespace {

bool has_setting(const DeviceSection& section, std::string_view key) {
  return std::ranges::find(section.all(), key, &Setting::key) != section.all().end();
}

}  // namespace

DeviceReader::Outcome DeviceReader::read_connection(std::size_t i) {
  if (config_.connection_count == kMaxConnections) {
    return refuse(i, {}, "too many connections: there is room for 4");
  }
  ConnectionConfig& connection = config_.connections[config_.connection_count];
  connection_sections_[config_.connection_count] = i;
  ++config_.connection_count;
  if (!drivers::choose_connection(connection.line, text_of(sections_.sections[i], kKindKey))) {
    return refuse(i, kKindKey, drivers::kConnectionRule.view());
  }
  return assign_all(i, kKindKey, [&](auto& visit) { visit_connection(connection, visit); });
}

DeviceReader::Outcome DeviceReader::read_axis(std::size_t i) {
  if (config_.axis_count == kMaxAxes) {
    return refuse(i, {}, "too many axes: there is room for 6");
  }
  AxisConfig& axis = config_.axes[config_.axis_count];
  axis_sections_[config_.axis_count] = i;
  ++config_.axis_count;
  if (!drivers::choose_drive(axis.drive, text_of(sections_.sections[i], kDriverKey))) {
    return refuse(i, kDriverKey, drivers::kDriverRule.view());
  }
  if (const auto read = assign_all(i, kDriverKey, [&](auto& visit) { visit_axis(axis, visit); });
      !read) {
    return read;
  }
  if (const auto found = find_connection(i, axis); !found) {
    return found;
  }
  drivers::visit_drive(axis.drive, [&](const auto& driver, auto& drive) {
    if (driver.take_encoder != nullptr) {
      driver.take_encoder(drive, axis.encoder);
    }
  });
  return as_outcome(i, check_drive(axis, config_));
}

DeviceReader::Outcome DeviceReader::find_connection(std::size_t i, AxisConfig& axis) {
  const auto all = std::span(config_.connections).first(config_.connection_count);
  const auto found = std::ranges::find(all, axis.connection_name, &ConnectionConfig::name);
  if (found == all.end() || axis.connection_name.empty()) {
    return refuse(i, "connection", "must be the name of a [[connection]]");
  }
  axis.connection = static_cast<std::size_t>(found - all.begin());
  const bool fits =
      drivers::visit_drive(axis.drive, [&](const auto& driver, const auto& /*drive*/) {
        using Connection = typename std::remove_cvref_t<decltype(driver)>::Connection;
        return std::holds_alternative<Connection>(found->line);
      });
  if (!fits) {
    return refuse(i, "connection", "is of a kind that this driver cannot use");
  }
  return {};
}

DeviceReader::Outcome DeviceReader::find_axis(std::size_t i, std::string_view key,
                                              std::string_view name, std::size_t& found) {
  const auto all = std::span(config_.axes).first(config_.axis_count);
  const auto at = std::ranges::find(all, name, &AxisConfig::name);
  if (at == all.end() || name.empty()) {
    return refuse(i, key, "must be the name of an [[axis]]");
  }
  found = static_cast<std::size_t>(at - all.begin());
  return {};
}

DeviceReader::Outcome DeviceReader::read_joint(std::size_t i) {
  const std::size_t count = joint_count(config_.controller.mechanism);
  if (config_.joint_count == count) {
    return refuse(i, {}, "the mechanism has fewer joints than there are [[joint]] tables");
  }
  JointConfig& joint = config_.joints[config_.joint_count];
  joint_sections_[config_.joint_count] = i;
  joint.limits = config_.controller.joints[config_.joint_count];
  if (const auto read = assign_all(i, {}, [&](auto& visit) { visit(joint, joint_keys()); });
      !read) {
    return read;
  }
  joint.has_reference = has_setting(sections_.sections[i], "reference");
  if (joint.encoder_name.empty()) {
    joint.encoder_name = joint.motor_name;
  }
  if (const auto found = find_axis(i, "motor", joint.motor_name, joint.motor); !found) {
    return found;
  }
  if (const auto found = find_axis(i, "encoder", joint.encoder_name, joint.encoder); !found) {
    return found;
  }
  if (!is_valid(joint.transmission)) {
    return refuse(i, "motor_ratio",
                  "ratios must be above 0 (a turned direction is written as motor_direction = -1), "
                  "directions 1 or -1");
  }
  joint.reference.lower = joint.limits.lower;
  joint.reference.upper = joint.limits.upper;
  if (const auto checked = as_outcome(i, check(joint.reference)); !checked) {
    return checked;
  }

  config_.controller.joints[config_.joint_count] = joint.limits;
  ++config_.joint_count;
  return {};
}

// Tells each board the angles of its axes in their known poses, from which it counts.
void DeviceReader::place_boards() {
  for (const JointConfig& joint : std::span(config_.joints).first(config_.joint_count)) {
    if (joint.reference.kind != drivers::ReferenceKind::known_pose) {
      continue;
    }
    const AxisConfig& axis = config_.axes[joint.encoder];
    auto& line = config_.connections[axis.connection].line;
    drivers::visit_drive(axis.drive, [&](const auto& driver, const auto& drive) {
      using Connection = typename std::remove_cvref_t<decltype(driver)>::Connection;
      if (driver.stand_at != nullptr) {
        driver.stand_at(
            std::get<Connection>(line), drive,
            drivers::encoder_position_rad(joint.transmission, joint.reference.position));
      }
    });
  }
}

}  // namespace tactus::firmware
