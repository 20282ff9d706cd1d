#include "host_tools/monitor/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "firmware/control/parameter_choices.h"
#include "firmware/control/parameter_name.h"
#include "firmware/safety/energy_ledger.h"
#include "firmware/safety/faults.h"
#include "firmware/telemetry/record_fields.h"
#include "host_tools/recording/record_columns.h"
#include "rendering/touch_names.h"

namespace tactus::host {

namespace {

using firmware::FieldName;

// The fields of a user who names none.
constexpr std::array<std::string_view, 10> kUsualFields = {
    "tick",     "mode",     "faults", "limits",  "tool_x_m",
    "tool_y_m", "tool_z_m", "proxy",  "contact", "force"};

// Returns the names of all set bits, separated by commas; "none" without any.
std::string fault_names(std::uint64_t bits) {
  std::string names;
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    if ((bits & text.bit) != 0) {
      names += (names.empty() ? "" : ",") + std::string(text.name);
    }
  }
  return names.empty() ? "none" : names;
}

// Returns the word of an enumeration's value, or its number if this version does not know it.
template <std::size_t kCount, class Enum>
std::string word_of(const std::array<std::string_view, kCount>& words, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < kCount ? std::string(words[index]) : fmt::format("{}", index);
}

// Returns the word or number of a column.
template <class Field>
std::string text_of(const FieldName& name, const Field& field) {
  if constexpr (std::is_same_v<Field, firmware::Mode>) {
    return word_of(firmware::kModeNames, field);
  } else if constexpr (std::is_same_v<Field, firmware::Request>) {
    return word_of(firmware::kRequestNames, field);
  } else if constexpr (std::is_same_v<Field, rendering::ContactKind>) {
    return word_of(rendering::kContactNames, field);
  } else if constexpr (std::is_same_v<Field, rendering::FrictionState>) {
    return word_of(rendering::kFrictionNames, field);
  } else if constexpr (std::is_same_v<Field, firmware::EnergySource>) {
    return word_of(firmware::kEnergySourceNames, field);
  } else if constexpr (std::is_enum_v<Field>) {
    return fmt::format("{}", static_cast<unsigned>(field));
  } else if constexpr (std::is_floating_point_v<Field>) {
    return fmt::format("{:.9g}", field);
  } else if (name.name == "faults" || name.name == "limits") {
    return fault_names(static_cast<std::uint64_t>(field));
  } else if (name.name == "state_hash") {
    return fmt::format("{:016x}", field);
  } else {
    return fmt::format("{}", field);
  }
}

// Returns the value of an event as a number, or by its name if it is a friction model or a contact
// method.
std::string value_of(const firmware::TelemetryEvent& event) {
  if (event.kind == firmware::EventKind::parameter) {
    const auto name = firmware::parse_parameter_name(firmware::name_of(event));
    const std::string_view choice =
        name ? firmware::choice_name(name->parameter, event.value) : std::string_view{};
    if (!choice.empty()) {
      return std::string(choice);
    }
  }
  return fmt::format("{:.9g}", event.value);
}

}  // namespace

WatchLines::WatchLines(std::vector<std::string> fields, std::uint64_t every)
    : fields_(std::move(fields)), every_(std::max<std::uint64_t>(every, 1)) {
  if (fields_.empty()) {
    fields_.assign(kUsualFields.begin(), kUsualFields.end());
  }
}

std::string WatchLines::line(const firmware::RecordedTick& tick) {
  if (names_.empty()) {
    joints_ = std::min<std::size_t>(tick.joint_count, drivers::kMaxJoints);
    names_ = column_names(joints_);
    columns_ = chosen_columns(fields_, joints_);
  }
  if (seen_++ % every_ != 0) {
    return {};
  }
  std::vector<std::string> words;
  words.reserve(names_.size());
  firmware::visit_tick_columns(tick, joints_,
                               [&](const firmware::ColumnName& column, const auto& value) {
                                 words.push_back(text_of(column.field, value));
                               });
  std::string text;
  for (const std::size_t i : columns_) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", names_[i], words[i]);
  }
  return text;
}

std::string WatchLines::line(const firmware::TelemetryEvent& event) {
  return fmt::format("event tick={} kind={} name={} value={}", event.tick, kind_of(event),
                     firmware::name_of(event), value_of(event));
}

}  // namespace tactus::host
