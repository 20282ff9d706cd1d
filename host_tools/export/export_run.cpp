#include "host_tools/export/export_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ranges>
#include <type_traits>
#include <variant>

#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/record_columns.h"
#include "host_tools/simulation/run_log.h"

namespace tactus::host {
namespace {

// Appends the shortest text that reads back as the same number.
void append_number(std::string& text, auto number) {
  std::array<char, 32> room{};
  const auto end = std::to_chars(room.data(), room.data() + room.size(), number).ptr;
  text.append(room.data(), end);
}

// Appends a name to a line of CSV, in double quotes: it may have a comma.
void append_quoted(std::string& text, std::string_view name) {
  text += '"';
  for (const char each : name) {
    text += each == '"' ? "\"\"" : std::string(1, each);
  }
  text += '"';
}

void append_csv(std::string& text, const ColumnValue& value) {
  std::visit(
      [&](const auto& each) {
        using Value = std::remove_cvref_t<decltype(each)>;
        if constexpr (std::is_same_v<Value, HashValue>) {
          text += fmt::format("{:016x}", each.hash);
        } else if constexpr (std::is_same_v<Value, std::string_view>) {
          text += each;
        } else {
          append_number(text, each);
        }
      },
      value);
}

void append_json(std::string& text, const ColumnValue& value) {
  const double* const real = std::get_if<double>(&value);
  if (real != nullptr && !std::isfinite(*real)) {
    text += "null";
    return;
  }
  const bool is_text =
      std::holds_alternative<HashValue>(value) || std::holds_alternative<std::string_view>(value);
  text += is_text ? "\"" : "";
  append_csv(text, value);
  text += is_text ? "\"" : "";
}

// The text of ticks in one of the formats.
class TickText {
 public:
  // Chooses the columns. Throws InputError for a field that is not known.
  TickText(const ExportChoice& choice, ExportFormat format, std::size_t joints)
      : format_(format), joints_(joints), names_(column_names(joints)) {
    if (choice.fields.empty()) {
      columns_.reserve(names_.size());
      std::ranges::copy(std::views::iota(std::size_t{0}, names_.size()),
                        std::back_inserter(columns_));
    } else {
      columns_ = chosen_columns(choice.fields, joints);
    }
  }

  [[nodiscard]] std::size_t columns() const { return columns_.size(); }

  // Returns the first line of the file: the names in CSV, nothing in JSON.
  [[nodiscard]] std::string header() const {
    if (format_ == ExportFormat::json_lines) {
      return {};
    }
    std::string text;
    for (const std::size_t column : columns_) {
      text += text.empty() ? "" : ",";
      text += names_[column];
    }
    return text + "\n";
  }

  // Appends the line of a tick.
  void append(const firmware::RecordedTick& tick, std::string& text) {
    read_columns(tick, joints_, values_);
    const bool is_json = format_ == ExportFormat::json_lines;
    std::string_view before = is_json ? "{" : "";
    for (const std::size_t column : columns_) {
      text += before;
      before = ",";
      if (is_json) {
        text += '"' + names_[column] + "\":";
        append_json(text, values_[column]);
      } else {
        append_csv(text, values_[column]);
      }
    }
    text += is_json ? "}\n" : "\n";
  }

 private:
  ExportFormat format_;
  std::size_t joints_;
  std::vector<std::string> names_;
  std::vector<std::size_t> columns_;
  std::vector<ColumnValue> values_;
};

std::string no_tick_between(const ExportChoice& choice, double last_s) {
  const std::string from =
      std::isfinite(choice.from_s) ? fmt::format(" from {} s on", choice.from_s) : "";
  const std::string to = std::isfinite(choice.to_s) ? fmt::format(" up to {} s", choice.to_s) : "";
  return fmt::format("the run has no tick{}{}; it ends at {:.3f} s", from, to, last_s);
}

}  // namespace

std::optional<ExportFormat> export_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".csv") {
    return ExportFormat::csv;
  }
  if (extension == ".jsonl" || extension == ".ndjson") {
    return ExportFormat::json_lines;
  }
  return std::nullopt;
}

ExportSummary export_ticks(Recording& recording, const ExportChoice& choice, ExportFormat format,
                           const std::filesystem::path& output,
                           const std::function<void(double time_s)>& see) {
  constexpr std::uint64_t kTicksBetweenViews = 1000;
  recording.rewind();
  auto tick = recording.next();
  if (!tick) {
    throw InputError("the recording holds no tick");
  }
  TickText text(choice, format, tick->joint_count);
  LogFile file(output, text.header());
  ExportSummary summary{.columns = text.columns()};
  std::uint64_t within = 0;
  double last_s = 0.0;
  for (std::uint64_t count = 0; tick; tick = recording.next(), ++count) {
    last_s = tick->record.time_s;
    if (count % kTicksBetweenViews == 0) {
      see(last_s);
    }
    if (last_s < choice.from_s || last_s > choice.to_s || within++ % choice.every != 0) {
      continue;
    }
    summary.first_s = summary.ticks == 0 ? last_s : summary.first_s;
    summary.last_s = last_s;
    ++summary.ticks;
    text.append(*tick, file.buffer());
    file.flush_if_full();
  }
  if (summary.ticks == 0) {
    throw InputError(no_tick_between(choice, last_s));
  }
  file.close();
  return summary;
}

std::size_t export_events(const Recording& recording, ExportFormat format,
                          const std::filesystem::path& output) {
  const bool is_json = format == ExportFormat::json_lines;
  LogFile file(output, is_json ? "" : "tick,kind,name,value\n");
  for (const firmware::TelemetryEvent& event : recording.events()) {
    const std::string_view kind = kind_of(event);
    const std::string_view name = firmware::name_of(event);
    std::string& text = file.buffer();
    if (is_json) {
      const nlohmann::ordered_json line{
          {"tick", event.tick}, {"kind", kind}, {"name", name}, {"value", event.value}};
      text += line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    } else {
      text += fmt::format("{},{},", event.tick, kind);
      append_quoted(text, name);
      text += ',';
      append_number(text, event.value);
    }
    text += '\n';
    file.flush_if_full();
  }
  file.close();
  return recording.events().size();
}

}  // namespace tactus::host
