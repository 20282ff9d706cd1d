#include "host_tools/export/export_run.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/telemetry/telemetry_event.h"
#include "host_tools/export/chosen_ticks.h"
#include "host_tools/export/npz.h"
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
  TickText(std::vector<ChosenColumn> columns, ExportFormat format, std::size_t joints)
      : format_(format), joints_(joints), columns_(std::move(columns)) {}

  // Returns the first line of the file: the names in CSV, nothing in JSON.
  [[nodiscard]] std::string header() const {
    if (format_ == ExportFormat::json_lines) {
      return {};
    }
    std::string text;
    for (const ChosenColumn& column : columns_) {
      text += text.empty() ? "" : ",";
      text += column.name;
    }
    return text + "\n";
  }

  // Appends the line of a tick.
  void append(const firmware::RecordedTick& tick, std::string& text) {
    read_columns(tick, joints_, values_);
    const bool is_json = format_ == ExportFormat::json_lines;
    std::string_view before = is_json ? "{" : "";
    for (const ChosenColumn& column : columns_) {
      text += before;
      before = ",";
      if (is_json) {
        text += '"' + column.name + "\":";
        append_json(text, values_[column.index]);
      } else {
        append_csv(text, values_[column.index]);
      }
    }
    text += is_json ? "}\n" : "\n";
  }

 private:
  ExportFormat format_;
  std::size_t joints_;
  std::vector<ChosenColumn> columns_;
  std::vector<ColumnValue> values_;
};

}  // namespace

std::optional<ExportFormat> export_format(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".csv") {
    return ExportFormat::csv;
  }
  if (extension == ".jsonl" || extension == ".ndjson") {
    return ExportFormat::json_lines;
  }
  if (extension == ".npz") {
    return ExportFormat::npz;
  }
  return std::nullopt;
}

ExportSummary export_ticks(Recording& recording, const ExportChoice& choice, ExportFormat format,
                           const std::filesystem::path& output,
                           const std::function<void(double time_s)>& see) {
  const std::size_t joints = joints_of(recording);
  std::vector<ChosenColumn> columns = columns_of(choice, joints);
  const std::size_t column_count = columns.size();
  ExportSummary summary;
  if (format == ExportFormat::npz) {
    summary = write_npz(recording, choice, columns, output, see);
  } else {
    TickText text(std::move(columns), format, joints);
    LogFile file(output, text.header());
    summary = visit_chosen_ticks(recording, choice, see, [&](const firmware::RecordedTick& tick) {
      text.append(tick, file.buffer());
      file.flush_if_full();
    });
    file.close();
  }
  summary.columns = column_count;
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
