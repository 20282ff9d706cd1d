#include "host_tools/emulators/paddle_wiring.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using drivers::AxisPins;

// gpio-sim makes chips of at most this many lines here.
constexpr std::uint32_t kMostLines = 64;

constexpr std::array<std::pair<std::string_view, std::optional<drivers::InputPin> AxisPins::*>, 7>
    kPaddleInputs = {{{"encoder_a", &AxisPins::encoder_a},
                      {"encoder_b", &AxisPins::encoder_b},
                      {"encoder_index", &AxisPins::encoder_index},
                      {"fault", &AxisPins::fault},
                      {"emergency_stop", &AxisPins::emergency_stop},
                      {"limit_low", &AxisPins::limit_low},
                      {"limit_high", &AxisPins::limit_high}}};
constexpr std::array<std::pair<std::string_view, std::optional<drivers::OutputPin> AxisPins::*>, 4>
    kPaddleOutputs = {{{"direction", &AxisPins::direction},
                       {"enable", &AxisPins::enable},
                       {"brake_release", &AxisPins::brake_release},
                       {"heartbeat", &AxisPins::heartbeat}}};

struct NamedLine {
  std::string_view name;
  std::uint32_t offset = 0;
  bool active_low = false;
};

NamedLine parse_line(std::string_view text) {
  constexpr std::string_view kActiveLow = ":active_low";
  NamedLine line;
  std::string_view rest = text;
  if (rest.ends_with(kActiveLow)) {
    line.active_low = true;
    rest.remove_suffix(kActiveLow.size());
  }
  const std::size_t equals = rest.find('=');
  line.name = rest.substr(0, equals);
  const std::string_view number =
      equals == std::string_view::npos ? std::string_view{} : rest.substr(equals + 1);
  const char* const end = number.data() + number.size();
  const auto [stopped, error] = std::from_chars(number.data(), end, line.offset);
  if (number.empty() || error != std::errc{} || stopped != end || line.offset >= kMostLines) {
    throw InputError(fmt::format(
        "--pins: '{}'; write NAME=LINE, LINE from 0 to {}, like encoder_a=0 or fault=4:active_low",
        text, kMostLines - 1));
  }
  return line;
}

// Sets the pin of that name; returns false if the table has no such name.
template <class Table, class Pin>
bool put_line(const Table& table, const NamedLine& line, const Pin& pin, AxisPins& pins) {
  const auto found = std::ranges::find(table, line.name, &Table::value_type::first);
  if (found == table.end()) {
    return false;
  }
  pins.*(found->second) = pin;
  return true;
}

}  // namespace

drivers::AxisPins parse_pins(std::span<const std::string> texts) {
  AxisPins pins;
  std::vector<std::uint32_t> used;
  for (const std::string& text : texts) {
    const NamedLine line = parse_line(text);
    if (std::ranges::find(used, line.offset) != used.end()) {
      throw InputError(fmt::format("--pins: line {} is given twice", line.offset));
    }
    used.push_back(line.offset);
    const drivers::InputPin input{.offset = line.offset, .active_low = line.active_low};
    const drivers::OutputPin output{.offset = line.offset, .active_low = line.active_low};
    if (!put_line(kPaddleInputs, line, input, pins) &&
        !put_line(kPaddleOutputs, line, output, pins)) {
      throw InputError(
          fmt::format("--pins: there is no '{}'; there are: encoder_a, encoder_b, encoder_index, "
                      "fault, emergency_stop, limit_low, limit_high, direction, enable, "
                      "brake_release, heartbeat",
                      line.name));
    }
  }
  return pins;
}

}  // namespace tactus::host
