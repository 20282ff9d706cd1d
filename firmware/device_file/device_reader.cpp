// Reads sections into a configuration. The kind or driver of a section chooses the tables of keys,
// every setting is assigned to its field, and then the parts check themselves and each other.
#include <algorithm>
#include <span>
#include <variant>

#include "firmware/device_file/device_certificate.h"
#include "firmware/device_file/device_checks.h"
#include "firmware/device_file/device_commissioning.h"
#include "firmware/device_file/device_image.h"
#include "firmware/device_file/device_settings.h"
#include "firmware/device_file/device_tables.h"

namespace tactus::firmware {

namespace {

using Outcome = std::expected<void, DeviceError>;

Outcome refuse(std::size_t section, std::string_view key, std::string_view what) {
  return std::unexpected(DeviceError{what, section, key});
}

Outcome as_outcome(std::size_t section, const drivers::Checked& checked) {
  return checked ? Outcome{} : refuse(section, checked.error().field, checked.error().rule);
}

std::string_view text_of(const DeviceSection& section, std::string_view key) {
  for (const Setting& setting : section.all()) {
    if (setting.key == key && setting.type == SettingType::text) {
      return setting.text;
    }
  }
  return {};
}

bool has_setting(const DeviceSection& section, std::string_view key) {
  return std::ranges::find(section.all(), key, &Setting::key) != section.all().end();
}

class DeviceReader {
 public:
  DeviceReader(const DeviceSections& sections, DeviceConfig& config)
      : sections_(sections), config_(config) {}

  Outcome read();
  std::size_t list_keys(std::size_t section, std::span<KnownKey> keys);

 private:
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

  Outcome choose_connection(std::size_t i, ConnectionConfig& connection);
  Outcome choose_drive(std::size_t i, AxisConfig& axis);
  Outcome find_connection(std::size_t i, AxisConfig& axis);
  Outcome find_axis(std::size_t i, std::string_view key, std::string_view name, std::size_t& found);
  void choose_moving_mass();
  Outcome finish();
  [[nodiscard]] std::span<const Binding<JointConfig>> joint_keys() const {
    return std::holds_alternative<CartesianGeometry>(config_.controller.mechanism)
               ? sliding_joint_keys()
               : turning_joint_keys();
  }
  [[nodiscard]] std::span<const Binding<PlantConfig>> plant_keys() const {
    return std::holds_alternative<CartesianGeometry>(config_.controller.mechanism)
               ? sliding_plant_keys()
               : turning_plant_keys();
  }

  [[nodiscard]] std::size_t section_of(const Refusal& refusal) const;
  void place_haply_arms();

  const DeviceSections& sections_;
  DeviceConfig& config_;
  // The sections of the connections, axes and joints, in the configuration's order.
  std::array<std::size_t, kMaxConnections> connection_sections_{};
  std::array<std::size_t, kMaxAxes> axis_sections_{};
  std::array<std::size_t, kJointCount> joint_sections_{};
};

template <class VisitTables>
Outcome DeviceReader::assign_all(std::size_t section, std::string_view choosing,
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

Outcome DeviceReader::for_each(std::string_view kind, Step step) {
  for (std::size_t i = 0; i < sections_.count; ++i) {
    if (sections_.sections[i].kind == kind) {
      if (const auto outcome = (this->*step)(i); !outcome) {
        return outcome;
      }
    }
  }
  return {};
}

Outcome DeviceReader::read() {
  config_ = {};
  constexpr std::array<std::string_view, 9> kKinds = {
      "mechanism", "device", "controller",     "plant",           "connection",
      "axis",      "joint",  kCertificateKind, kCommissioningKind};
  for (std::size_t i = 0; i < sections_.count; ++i) {
    if (std::ranges::find(kKinds, sections_.sections[i].kind) == kKinds.end()) {
      return refuse(i, {},
                    "unknown section; there are: [controller], [mechanism], [plant], "
                    "[[connection]], [[axis]] and [[joint]]");
    }
  }
  constexpr std::array<Step, kKinds.size()> kSteps = {
      &DeviceReader::read_mechanism,    &DeviceReader::read_top,
      &DeviceReader::read_controller,   &DeviceReader::read_plant,
      &DeviceReader::read_connection,   &DeviceReader::read_axis,
      &DeviceReader::read_joint,        &DeviceReader::take_certificate,
      &DeviceReader::take_commissioning};
  for (std::size_t k = 0; k < kSteps.size(); ++k) {
    if (const auto outcome = for_each(kKinds[k], kSteps[k]); !outcome) {
      return outcome;
    }
  }
  return finish();
}

// The mechanism is read first, because its preset also fills the controller's section.
Outcome DeviceReader::read_mechanism(std::size_t i) {
  const auto preset = preset_config(text_of(sections_.sections[i], kKindKey));
  if (!preset) {
    return refuse(i, kKindKey,
                  R"(must be "cartesian", "falcon", "hapkit", "haply_pantograph", )"
                  R"("phantom_premium" or "woodenhaptics")");
  }
  config_.controller = *preset;
  return assign_all(i, kKindKey,
                    [this](auto& visit) { visit_mechanism(config_.controller.mechanism, visit); });
}

Outcome DeviceReader::read_top(std::size_t i) {
  return assign_all(i, {}, [this](auto& visit) { visit(config_, device_keys()); });
}

Outcome DeviceReader::read_controller(std::size_t i) {
  return assign_all(i, {}, [this](auto& visit) { visit(config_.controller, controller_keys()); });
}

Outcome DeviceReader::read_plant(std::size_t i) {
  PlantConfig& plant = config_.plant;
  if (const auto read = assign_all(i, {}, [&](auto& visit) { visit(plant, plant_keys()); });
      !read) {
    return read;
  }
  return as_outcome(i, check(plant));
}

Outcome DeviceReader::read_connection(std::size_t i) {
  if (config_.connection_count == kMaxConnections) {
    return refuse(i, {}, "too many connections: there is room for 4");
  }
  ConnectionConfig& connection = config_.connections[config_.connection_count];
  connection_sections_[config_.connection_count] = i;
  ++config_.connection_count;
  if (const auto chosen = choose_connection(i, connection); !chosen) {
    return chosen;
  }
  return assign_all(i, kKindKey, [&](auto& visit) { visit_connection(connection, visit); });
}

Outcome DeviceReader::choose_connection(std::size_t i, ConnectionConfig& connection) {
  const std::string_view kind = text_of(sections_.sections[i], kKindKey);
  if (kind == "can") {
    connection.line = CanConnection{};
  } else if (kind == "falcon_usb") {
    connection.line = FalconConnection{};
  } else if (kind == "haply_serial") {
    connection.line = HaplyConnection{};
  } else if (kind == "gpio") {
    connection.line = GpioConnection{};
  } else {
    return refuse(i, kKindKey, R"(must be "can", "falcon_usb", "haply_serial" or "gpio")");
  }
  return {};
}

Outcome DeviceReader::read_axis(std::size_t i) {
  if (config_.axis_count == kMaxAxes) {
    return refuse(i, {}, "too many axes: there is room for 6");
  }
  AxisConfig& axis = config_.axes[config_.axis_count];
  axis_sections_[config_.axis_count] = i;
  ++config_.axis_count;
  if (const auto chosen = choose_drive(i, axis); !chosen) {
    return chosen;
  }
  if (const auto read = assign_all(i, kDriverKey, [&](auto& visit) { visit_axis(axis, visit); });
      !read) {
    return read;
  }
  if (const auto found = find_connection(i, axis); !found) {
    return found;
  }
  if (auto* moteus = std::get_if<drivers::MoteusConfig>(&axis.drive)) {
    moteus->absolute_output = axis.encoder == EncoderKind::absolute;
  }
  return as_outcome(i, check_drive(axis, config_));
}

Outcome DeviceReader::choose_drive(std::size_t i, AxisConfig& axis) {
  const std::string_view driver = text_of(sections_.sections[i], kDriverKey);
  if (driver == "odrive_can") {
    axis.drive = drivers::ODriveConfig{};
  } else if (driver == "moteus_canfd") {
    axis.drive = drivers::MoteusConfig{};
  } else if (driver == "cia402_can") {
    axis.drive = drivers::Cia402Config{};
  } else if (driver == "vesc_can") {
    axis.drive = drivers::VescConfig{};
  } else if (driver == "gpio_axis") {
    axis.drive = drivers::GpioAxisConfig{};
  } else if (driver == "falcon_usb" || driver == "haply_serial") {
    axis.drive = BoardAxis{};
  } else {
    return refuse(i, kDriverKey,
                  R"(must be "odrive_can", "moteus_canfd", "cia402_can", "vesc_can", )"
                  R"("gpio_axis", "falcon_usb" or "haply_serial")");
  }
  return {};
}

Outcome DeviceReader::find_connection(std::size_t i, AxisConfig& axis) {
  const auto all = std::span(config_.connections).first(config_.connection_count);
  const auto found = std::ranges::find(all, axis.connection_name, &ConnectionConfig::name);
  if (found == all.end() || axis.connection_name.empty()) {
    return refuse(i, "connection", "must be the name of a [[connection]]");
  }
  axis.connection = static_cast<std::size_t>(found - all.begin());
  const std::string_view driver = text_of(sections_.sections[i], kDriverKey);
  const bool fits = driver.contains("_can")  ? std::holds_alternative<CanConnection>(found->line)
                    : driver == "gpio_axis"  ? std::holds_alternative<GpioConnection>(found->line)
                    : driver == "falcon_usb" ? std::holds_alternative<FalconConnection>(found->line)
                                             : std::holds_alternative<HaplyConnection>(found->line);
  if (!fits) {
    return refuse(i, "connection", "is of a kind that this driver cannot use");
  }
  return {};
}

Outcome DeviceReader::find_axis(std::size_t i, std::string_view key, std::string_view name,
                                std::size_t& found) {
  const auto all = std::span(config_.axes).first(config_.axis_count);
  const auto at = std::ranges::find(all, name, &AxisConfig::name);
  if (at == all.end() || name.empty()) {
    return refuse(i, key, "must be the name of an [[axis]]");
  }
  found = static_cast<std::size_t>(at - all.begin());
  return {};
}

Outcome DeviceReader::read_joint(std::size_t i) {
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

Outcome DeviceReader::take_certificate(std::size_t i) {
  if (config_.certification.is_there) {
    return refuse(i, {}, "a device has one certificate");
  }
  const auto read = read_certificate(sections_, i);
  if (!read) {
    return std::unexpected(read.error());
  }
  config_.certification = *read;
  config_.controller.certificate = read->limits;
  return {};
}

Outcome DeviceReader::take_commissioning(std::size_t i) {
  if (config_.commissioning.is_there) {
    return refuse(i, {}, "a device has one commissioning");
  }
  const auto read = read_commissioning(sections_, i);
  if (!read) {
    return std::unexpected(read.error());
  }
  config_.commissioning = *read;
  return {};
}

// Sets the mass against which the tick checks the joints' answers: the given one, or the
// commissioned one.
void DeviceReader::choose_moving_mass() {
  const Commissioning& commissioning = config_.commissioning;
  const double commissioned = commissioning.is_for_these_settings && commissioning.passed
                                  ? commissioning.moving_mass_kg
                                  : 0.0;
  config_.controller.safety.moving_mass_kg = config_.plant.moving_mass_kg.value_or(commissioned);
}

Outcome DeviceReader::finish() {
  choose_moving_mass();
  if (config_.joint_count != joint_count(config_.controller.mechanism)) {
    return refuse(0, {}, "the mechanism has more joints than there are [[joint]] tables");
  }
  if (const Verdict verdict = check_whole(config_, config_.refusal); !verdict) {
    return refuse(section_of(verdict.error()), verdict.error().key, verdict.error().rule);
  }
  place_haply_arms();
  return as_outcome(0, check(config_));
}

std::size_t DeviceReader::section_of(const Refusal& refusal) const {
  switch (refusal.place) {
    case Place::connection:
      return connection_sections_[refusal.index];
    case Place::axis:
      return axis_sections_[refusal.index];
    case Place::joint:
      return joint_sections_[refusal.index];
    case Place::device:
      break;
  }
  return 0;
}

// Sets the angles from which the board counts: those of the arms' known pose.
void DeviceReader::place_haply_arms() {
  for (const JointConfig& joint : std::span(config_.joints).first(config_.joint_count)) {
    const AxisConfig& axis = config_.axes[joint.encoder];
    auto* haply = std::get_if<HaplyConnection>(&config_.connections[axis.connection].line);
    if (haply != nullptr && joint.reference.kind == drivers::ReferenceKind::known_pose) {
      haply->haply.axis[std::get<BoardAxis>(axis.drive).number].home_rad =
          drivers::encoder_position_rad(joint.transmission, joint.reference.position);
    }
  }
}

std::size_t DeviceReader::list_keys(std::size_t section, std::span<KnownKey> keys) {
  KeyCollector collect(keys);
  const std::string_view kind = sections_.sections[section].kind;
  if (kind == "mechanism" || kind == "connection") {
    collect.add(kKindKey, {});
  }
  if (kind == "axis") {
    collect.add(kDriverKey, {});
  }
  if (kind == "device") {
    collect(config_, device_keys());
  } else if (kind == "controller") {
    collect(config_.controller, controller_keys());
  } else if (kind == "mechanism") {
    visit_mechanism(config_.controller.mechanism, collect);
  } else if (kind == "plant") {
    collect(config_.plant, plant_keys());
  } else if (kind == "joint") {
    collect(config_.joints[0], joint_keys());
  } else if (kind == "connection") {
    ConnectionConfig connection;
    (void)choose_connection(section, connection);
    visit_connection(connection, collect);
  } else if (kind == "axis") {
    AxisConfig axis;
    (void)choose_drive(section, axis);
    visit_axis(axis, collect);
  }
  return collect.count();
}

}  // namespace

std::expected<void, DeviceError> read_device(const DeviceSections& sections, DeviceConfig& config) {
  return DeviceReader(sections, config).read();
}

std::size_t known_keys(const DeviceSections& sections, std::size_t section,
                       std::span<KnownKey> keys) {
  DeviceConfig config;
  DeviceReader reader(sections, config);
  (void)reader.read();
  return reader.list_keys(section, keys);
}

}  // namespace tactus::firmware
