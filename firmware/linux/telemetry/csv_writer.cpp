#include "firmware/linux/telemetry/csv_writer.h"

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>

#include "firmware/telemetry/record_fields.h"

namespace tactus::firmware {
namespace {

// Writes a column's name: the name, the element, and the unit.
void put_name(TextBuffer& text, const ColumnName& column) {
  const FieldName& name = column.field;
  text.text(text.size() == 0 ? "" : ",").text(name.column).text(column.before).text(column.element);
  text.text(name.unit.empty() ? "" : "_").text(name.unit);
}

template <class Value>
void put_value(TextBuffer& text, const ColumnName& column, const Value& value) {
  if constexpr (std::is_same_v<Value, Mode>) {
    text.text(mode_name(value));
  } else if constexpr (std::is_same_v<Value, Request>) {
    text.text(kRequestNames[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_enum_v<Value>) {
    text.number(static_cast<unsigned>(value));
  } else if (column.field.name == "state_hash") {
    text.hex(static_cast<std::uint64_t>(value));
  } else {
    text.number(value);
  }
}

}  // namespace

int CsvWriter::open(const char* path, std::size_t joints, IfThere if_there) {
  joints_ = std::min(joints, drivers::kMaxJoints);
  text_.clear();
  if (const int error = sink_.open(path, if_there); error != 0) {
    return error;
  }
  const RecordedTick any;
  visit_tick_columns(any, joints_, [&](const ColumnName& column, const auto& /*value*/) {
    put_name(text_, column);
  });
  text_.text("\n");
  flush();
  return sink_.error();
}

void CsvWriter::add(const RecordedTick& tick) {
  if (text_.room_left() < kLongestLine) {
    flush();
  }
  std::string_view separator;
  visit_tick_columns(tick, joints_, [&](const ColumnName& column, const auto& value) {
    text_.text(std::exchange(separator, ","));
    put_value(text_, column, value);
  });
  text_.text("\n");
}

void CsvWriter::flush() {
  sink_.write(std::as_bytes(text_.written()));
  text_.clear();
}

int CsvWriter::close() {
  if (!sink_.is_open()) {
    return 0;
  }
  flush();
  return sink_.close();
}

}  // namespace tactus::firmware
