#include "host_tools/monitor/tick_words.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <type_traits>

#include "firmware/safety/energy_ledger.h"
#include "firmware/safety/faults.h"
#include "firmware/telemetry/record_fields.h"
#include "rendering/touch_names.h"

namespace tactus::host {

namespace {

using firmware::FieldName;

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

// Returns true if a field's values are numbers.
template <class Field>
constexpr bool is_number(const FieldName& name) {
  return !std::is_enum_v<Field> && name.name != "faults" && name.name != "limits" &&
         name.name != "state_hash";
}

}  // namespace

void read_words(const firmware::RecordedTick& tick, std::size_t joints,
                std::vector<TickWord>& words) {
  words.clear();
  firmware::visit_tick_columns(
      tick, joints, [&]<class Field>(const firmware::ColumnName& column, const Field& value) {
        words.push_back(
            {.text = text_of(column.field, value), .is_number = is_number<Field>(column.field)});
      });
}

}  // namespace tactus::host
