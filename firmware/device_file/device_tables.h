// The tables of keys that a section of device.toml has, object by object, and two visitors of them:
// one assigns a setting to its field, the other lists the keys for advice.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "firmware/device_file/device_config.h"
#include "firmware/device_file/device_image.h"
#include "firmware/device_file/device_settings.h"
#include "firmware/device_file/setting.h"

namespace tactus::firmware {

// Assigns one setting to the field of its key, if one of the tables has the key.
class SettingAssigner {
 public:
  explicit SettingAssigner(const Setting& setting) : setting_(setting) {}

  template <class S>
  void operator()(S& object, std::span<const Binding<S>> table) {
    for (const Binding<S>& binding : table) {
      if (binding.key == setting_.key) {
        found_ = true;
        wrong_ = binding.assign(object, setting_);
      }
    }
  }
  // Returns the error, or an empty text if the setting was assigned.
  [[nodiscard]] std::string_view wrong() const { return found_ ? wrong_ : "unknown key"; }

 private:
  const Setting& setting_;
  std::string_view wrong_;
  bool found_ = false;
};

// Collects every key of the tables, as many as there is room for.
class KeyCollector {
 public:
  explicit KeyCollector(std::span<KnownKey> keys) : keys_(keys) {}

  void add(std::string_view key, std::string_view unit) {
    if (count_ < keys_.size()) {
      keys_[count_] = {key, unit};
      ++count_;
    }
  }
  template <class S>
  void operator()(S& /*object*/, std::span<const Binding<S>> table) {
    for (const Binding<S>& binding : table) {
      add(binding.key, binding.unit);
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::span<KnownKey> keys_;
  std::size_t count_ = 0;
};

// These call visit(object, table of its bindings) for each table of a section. An assigner and a
// collector are visitors.
template <class Visitor>
void visit_connection(ConnectionConfig& connection, Visitor&& visit) {
  visit(connection, connection_keys());
  drivers::visit_connection(connection.line,
                            [&](const auto& kind, auto& line) { visit(line, kind.keys()); });
}

template <class Visitor>
void visit_axis(AxisConfig& axis, Visitor&& visit) {
  visit(axis, axis_keys());
  drivers::visit_drive(axis.drive,
                       [&](const auto& driver, auto& drive) { visit(drive, driver.keys()); });
}

}  // namespace tactus::firmware
