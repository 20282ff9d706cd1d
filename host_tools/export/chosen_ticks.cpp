#include "host_tools/export/chosen_ticks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

std::string no_tick_between(const ExportChoice& choice, double last_s) {
  const std::string from =
      std::isfinite(choice.from_s) ? fmt::format(" from {} s on", choice.from_s) : "";
  const std::string to = std::isfinite(choice.to_s) ? fmt::format(" up to {} s", choice.to_s) : "";
  return fmt::format("the run has no tick{}{}; it ends at {:.3f} s", from, to, last_s);
}

}  // namespace

std::vector<ChosenColumn> columns_of(const ExportChoice& choice, std::size_t joints) {
  const std::vector<std::string> names = column_names(joints);
  // Every column's own name stands for that column.
  const std::vector<std::string>& fields = choice.fields.empty() ? names : choice.fields;
  std::vector<ChosenColumn> columns;
  for (const std::size_t index : chosen_columns(fields, joints)) {
    columns.push_back({.name = names[index], .index = index});
  }
  return columns;
}

std::size_t joints_of(Recording& recording) {
  recording.rewind();
  const std::optional<firmware::RecordedTick> tick = recording.next();
  if (!tick) {
    throw InputError("the recording holds no tick");
  }
  recording.rewind();
  return tick->joint_count;
}

ExportSummary visit_chosen_ticks(Recording& recording, const ExportChoice& choice,
                                 const std::function<void(double time_s)>& see,
                                 const std::function<void(const firmware::RecordedTick&)>& visit) {
  constexpr std::uint64_t kTicksBetweenViews = 1000;
  ExportSummary summary;
  std::uint64_t read = 0;
  std::uint64_t within = 0;
  double last_s = 0.0;
  recording.rewind();
  while (const std::optional<firmware::RecordedTick> tick = recording.next()) {
    last_s = tick->record.time_s;
    if (read++ % kTicksBetweenViews == 0) {
      see(last_s);
    }
    if (last_s < choice.from_s || last_s > choice.to_s || within++ % choice.every != 0) {
      continue;
    }
    summary.first_s = summary.ticks == 0 ? last_s : summary.first_s;
    summary.last_s = last_s;
    ++summary.ticks;
    visit(*tick);
  }
  if (summary.ticks == 0) {
    throw InputError(no_tick_between(choice, last_s));
  }
  return summary;
}

}  // namespace tactus::host
