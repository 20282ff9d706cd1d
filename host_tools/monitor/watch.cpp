#include "host_tools/monitor/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "firmware/control/parameter_choices.h"
#include "firmware/control/parameter_name.h"
#include "host_tools/recording/record_columns.h"

namespace tactus::host {

namespace {

// The fields of a user who names none.
constexpr std::array<std::string_view, 10> kUsualFields = {
    "tick",     "mode",     "faults", "limits",  "tool_x_m",
    "tool_y_m", "tool_z_m", "proxy",  "contact", "force"};

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
  read_words(tick, joints_, words_);
  std::string text;
  for (const std::size_t i : columns_) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", names_[i], words_[i].text);
  }
  return text;
}

std::string WatchLines::line(const firmware::TelemetryEvent& event) {
  return fmt::format("event tick={} kind={} name={} value={}", event.tick, kind_of(event),
                     firmware::name_of(event), value_of(event));
}

}  // namespace tactus::host
