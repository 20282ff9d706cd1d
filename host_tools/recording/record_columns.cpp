#include "host_tools/recording/record_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <concepts>
#include <type_traits>

#include "firmware/safety/energy_ledger.h"
#include "firmware/telemetry/record_fields.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using firmware::FieldName;
using ValuesOfJoints = std::array<double, drivers::kMaxJoints>;

constexpr std::array<std::string_view, 3> kAxisColumns = {"_x", "_y", "_z"};

// A visitor of a tick's fields that collects the names of their columns.
class NameCollector {
 public:
  NameCollector(std::size_t joints, std::vector<std::string>& names)
      : joints_(joints), names_(names) {}

  void operator()(const FieldName& name, const auto& /*field*/) const { add(name, ""); }
  void operator()(const FieldName& name, const firmware::Triple& /*field*/) const {
    for (const std::string_view axis : kAxisColumns) {
      add(name, axis);
    }
  }
  void operator()(const FieldName& name, const ValuesOfJoints& /*field*/) const {
    for (std::size_t i = 1; i <= joints_; ++i) {
      add(name, std::to_string(i));
    }
  }
  void operator()(const FieldName& name, const firmware::EnergyLedger& /*field*/) const {
    for (const std::string_view source : firmware::kEnergySourceNames) {
      add(name, "_" + std::string(source));
    }
  }

 private:
  // Adds a column: "tool" with the part "_x" and the unit m is tool_x_m.
  void add(const FieldName& name, std::string_view part) const {
    std::string column(name.column);
    column += part;
    column += name.unit.empty() ? "" : "_";
    column += name.unit;
    names_.push_back(column);
  }

  std::size_t joints_;
  std::vector<std::string>& names_;
};

// A visitor that collects the values, in the order of NameCollector.
class ValueCollector {
 public:
  ValueCollector(std::size_t joints, std::vector<ColumnValue>& values)
      : joints_(joints), values_(values) {}

  template <class Field>
  void operator()(const FieldName& name, const Field& field) const {
    if constexpr (std::is_same_v<Field, firmware::Mode>) {
      add(firmware::mode_name(field));
    } else if constexpr (std::is_same_v<Field, firmware::Request>) {
      const auto index = static_cast<std::size_t>(field);
      constexpr auto& kWords = firmware::kRequestNames;
      add(index < kWords.size() ? kWords[index] : std::string_view("unknown"));
    } else if constexpr (std::is_floating_point_v<Field>) {
      add(static_cast<double>(field));
    } else if constexpr (std::signed_integral<Field>) {
      add(static_cast<std::int64_t>(field));
    } else if constexpr (std::is_same_v<Field, std::uint64_t>) {
      add(name.name == "state_hash" ? ColumnValue(HashValue{field}) : ColumnValue(field));
    } else {
      add(static_cast<std::uint64_t>(field));
    }
  }
  void operator()(const FieldName& /*name*/, const firmware::Triple& field) const {
    add_all(field);
  }
  void operator()(const FieldName& /*name*/, const ValuesOfJoints& field) const {
    add_all(std::span(field).first(joints_));
  }
  void operator()(const FieldName& /*name*/, const firmware::EnergyLedger& field) const {
    add_all(field);
  }

 private:
  void add(ColumnValue value) const { values_.push_back(value); }
  void add_all(std::span<const double> values) const {
    for (const double value : values) {
      add(value);
    }
  }

  std::size_t joints_;
  std::vector<ColumnValue>& values_;
};

// Returns true if `field` is the column's name, or its beginning up to an underscore or a number.
bool stands_for(std::string_view field, std::string_view name) {
  if (!name.starts_with(field)) {
    return false;
  }
  return name.size() == field.size() || name[field.size()] == '_' ||
         std::isdigit(static_cast<unsigned char>(name[field.size()])) != 0;
}

std::string unknown_field(const std::string& field, const std::vector<std::string>& names) {
  std::string text = "there is no field '";
  text.append(field).append("'; there are:");
  for (const std::string& name : names) {
    text.append(" ").append(name);
  }
  return text;
}

}  // namespace

std::vector<std::string> column_names(std::size_t joints) {
  std::vector<std::string> names;
  const firmware::RecordedTick any;
  firmware::visit_tick_fields(any, NameCollector(std::min(joints, drivers::kMaxJoints), names));
  return names;
}

std::vector<std::size_t> chosen_columns(std::span<const std::string> fields, std::size_t joints) {
  const std::vector<std::string> names = column_names(joints);
  std::vector<std::size_t> columns;
  for (const std::string& field : fields) {
    // A column's whole name means that column alone.
    const bool whole = std::ranges::find(names, field) != names.end();
    const std::size_t before = columns.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (whole ? names[i] == field : stands_for(field, names[i])) {
        columns.push_back(i);
      }
    }
    if (columns.size() == before) {
      throw InputError(unknown_field(field, names));
    }
  }
  return columns;
}

void read_columns(const firmware::RecordedTick& tick, std::size_t joints,
                  std::vector<ColumnValue>& values) {
  values.clear();
  firmware::visit_tick_fields(tick, ValueCollector(std::min(joints, drivers::kMaxJoints), values));
}

}  // namespace tactus::host
