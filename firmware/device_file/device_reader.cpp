#include "firmware/device_file/device_reader.h"

#include <algorithm>
#include <span>
#include <variant>

#include "firmware/device_file/device_certificate.h"
#include "firmware/device_file/device_commissioning.h"

namespace tactus::firmware {

DeviceReader::Outcome DeviceReader::for_each(std::string_view kind, Step step) {
  for (std::size_t i = 0; i < sections_.count; ++i) {
    if (sections_.sections[i].kind == kind) {
      if (const auto outcome = (this->*step)(i); !outcome) {
        return outcome;
      }
    }
  }
  return {};
}

DeviceReader::Outcome DeviceReader::read() {
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
DeviceReader::Outcome DeviceReader::read_mechanism(std::size_t i) {
  const auto preset = preset_config(text_of(sections_.sections[i], kKindKey));
  if (!preset) {
    static constexpr drivers::MustBe kMustBe(kPresetNames);
    return refuse(i, kKindKey, kMustBe.view());
  }
  config_.controller = *preset;
  config_.preset = text_of(sections_.sections[i], kKindKey);
  return assign_all(i, kKindKey,
                    [this](auto& visit) { visit_mechanism(config_.controller.mechanism, visit); });
}

DeviceReader::Outcome DeviceReader::read_top(std::size_t i) {
  return assign_all(i, {}, [this](auto& visit) { visit(config_, device_keys()); });
}

DeviceReader::Outcome DeviceReader::read_controller(std::size_t i) {
  return assign_all(i, {}, [this](auto& visit) { visit(config_.controller, controller_keys()); });
}

DeviceReader::Outcome DeviceReader::read_plant(std::size_t i) {
  PlantConfig& plant = config_.plant;
  if (const auto read = assign_all(i, {}, [&](auto& visit) { visit(plant, plant_keys()); });
      !read) {
    return read;
  }
  return as_outcome(i, check(plant));
}

DeviceReader::Outcome DeviceReader::take_certificate(std::size_t i) {
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

DeviceReader::Outcome DeviceReader::take_commissioning(std::size_t i) {
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

DeviceReader::Outcome DeviceReader::finish() {
  choose_moving_mass();
  if (config_.joint_count != joint_count(config_.controller.mechanism)) {
    return refuse(0, {}, "the mechanism has more joints than there are [[joint]] tables");
  }
  if (const Verdict verdict = check_whole(config_, config_.refusal); !verdict) {
    return refuse(section_of(verdict.error()), verdict.error().key, verdict.error().rule);
  }
  place_boards();
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
    (void)drivers::choose_connection(connection.line,
                                     text_of(sections_.sections[section], kKindKey));
    visit_connection(connection, collect);
  } else if (kind == "axis") {
    AxisConfig axis;
    (void)drivers::choose_drive(axis.drive, text_of(sections_.sections[section], kDriverKey));
    visit_axis(axis, collect);
  }
  return collect.count();
}

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
