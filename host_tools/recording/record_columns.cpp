#include "host_tools/recording/record_columns.h"

#include <algorithm>
#include <cctype>
#include <concepts>
#include <type_traits>

#include "firmware/telemetry/record_fields.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using firmware::ColumnName;

// Returns a column's name: "tool" with the element "_x" and the unit m is tool_x_m.
std::string name_of(const ColumnName& column) {
  std::string name(column.field.column);
  name.append(column.before).append(column.element);
  name.append(column.field.unit.empty() ? "" : "_").append(column.field.unit);
  return name;
}

template <class Value>
ColumnValue value_of(const ColumnName& column, const Value& value) {
  if constexpr (std::is_same_v<Value, firmware::Mode>) {
    return firmware::mode_name(value);
  } else if constexpr (std::is_same_v<Value, firmware::Request>) {
    const auto index = static_cast<std::size_t>(value);
    constexpr auto& kWords = firmware::kRequestNames;
    return index < kWords.size() ? kWords[index] : std::string_view("unknown");
  } else if constexpr (std::is_floating_point_v<Value>) {
    return static_cast<double>(value);
  } else if constexpr (std::signed_integral<Value>) {
    return static_cast<std::int64_t>(value);
  } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
    return column.field.name == "state_hash" ? ColumnValue(HashValue{value}) : ColumnValue(value);
  } else {
    return static_cast<std::uint64_t>(value);
  }
}

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

std::string_view kind_of(const firmware::TelemetryEvent& event) {
  const auto index = static_cast<std::size_t>(event.kind);
  constexpr auto& kKinds = firmware::kEventKindNames;
  return index < kKinds.size() ? kKinds[index] : std::string_view("unknown");
}

std::vector<std::string> column_names(std::size_t joints) {
  std::vector<std::string> names;
  const firmware::RecordedTick any;
  firmware::visit_tick_columns(any, joints, [&](const ColumnName& column, const auto& /*value*/) {
    names.push_back(name_of(column));
  });
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
  firmware::visit_tick_columns(tick, joints, [&](const ColumnName& column, const auto& value) {
    values.push_back(value_of(column, value));
  });
}

}  // namespace tactus::host
