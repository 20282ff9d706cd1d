// Reads sections into a configuration. The kind or driver of a section chooses the tables of keys,
// every setting is assigned to its field, and then the parts check themselves and each other.
//
// device_reader.cpp reads the device as a whole and part_reader.cpp its connections, axes and
// joints.
#pragma once

#include <array>
#include <cstddef>
#include <expected>
#include <span>
#include <string_view>
#include <variant>

#include "firmware/device_file/device_checks.h"
#include "firmware/device_file/device_image.h"
#include "firmware/device_file/device_settings.h"
#include "firmware/device_file/device_tables.h"

namespace tactus::firmware {

class DeviceReader {
 public:
  DeviceReader(const DeviceSections& sections, DeviceConfig& config)
      : sections_(sections), config_(config) {}

  // Reads every section.
  std::expected<void, DeviceError> read();
  // Writes the keys that a section may have, and returns their number.
  std::size_t list_keys(std::size_t section, std::span<KnownKey> keys);

 private:
  using Outcome = std::expected<void, DeviceError>;
  using Step = Outcome (DeviceReader::*)(std::size_t);

  Outcome for_each(std::string_view kind, Step step);
  // Assigns every setting of the section, except the one that chooses the tables, through
  // `visit_tables`.
  template <class VisitTables>
  Outcome assign_all(std::size_t section, std::string_view choosing, VisitTables&& visit_tables);

  Outcome read_mechanism(std::size_t i);
  Outcome read_top(std::size_t i);
  Outcome read_controller(std::size_t i);
  Outcome read_plant(std::size_t i);
  Outcome read_connection(std::size_t i);
  Outcome read_axis(std::size_t i);
  Outcome read_joint(std::size_t i);
  Outcome take_certificate(std::size_t i);
  Outcome take_commissioning(std::size_t i);

  Outcome find_connection(std::size_t i, AxisConfig& axis);
  Outcome find_axis(std::size_t i, std::string_view key, std::string_view name, std::size_t& found);
  void choose_moving_mass();
  Outcome finish();
  [[nodiscard]] std::span<const Binding<JointConfig>> joint_keys() const {
    return slides(config_.controller.mechanism) ? sliding_joint_keys() : turning_joint_keys();
  }
  [[nodiscard]] std::span<const Binding<PlantConfig>> plant_keys() const {
    return slides(config_.controller.mechanism) ? sliding_plant_keys() : turning_plant_keys();
  }

  [[nodiscard]] std::size_t section_of(const Refusal& refusal) const;
  void place_boards();

  const DeviceSections& sections_;
  DeviceConfig& config_;
  // The sections of the connections, axes and joints, in the configuration's order.
  std::array<std::size_t, kMaxConnections> connection_sections_{};
  std::array<std::size_t, kMaxAxes> axis_sections_{};
  std::array<std::size_t, kJointCount> joint_sections_{};
};

// Returns the refusal of a key of a section.
inline std::expected<void, DeviceError> refuse(std::size_t section, std::string_view key,
                                               std::string_view what) {
  return std::unexpected(DeviceError{what, section, key});
}

inline std::expected<void, DeviceError> as_outcome(std::size_t section,
                                                   const drivers::Checked& checked) {
  return checked ? std::expected<void, DeviceError>{}
                 : refuse(section, checked.error().field, checked.error().rule);
}

// Returns the text of a section's key; empty without one.
inline std::string_view text_of(const DeviceSection& section, std::string_view key) {
  for (const Setting& setting : section.all()) {
    if (setting.key == key && setting.type == SettingType::text) {
      return setting.text;
    }
  }
  return {};
}

template <class VisitTables>
DeviceReader::Outcome DeviceReader::assign_all(std::size_t section, std::string_view choosing,
                                               VisitTables&& visit_tables) {
  for (const Setting& setting : sections_.sections[section].all()) {
    if (setting.key == choosing) {
      continue;
    }
    SettingAssigner assigner(setting);
    visit_tables(assigner);
    if (!assigner.wrong().empty()) {
      return refuse(section, setting.key, assigner.wrong());
    }
  }
  return {};
}

}  // namespace tactus::firmware
