#include "firmware/linux/telemetry/csv_writer.h"

#include <algorithm>

#include "firmware/telemetry/record_fields.h"

namespace tactus::firmware {
namespace {

constexpr std::array<std::string_view, 3> kAxisNames = {"x", "y", "z"};

// Writes a column's name: the name, what stands before the element, the element, and the unit.
void put_column(TextBuffer& text, const FieldName& name, std::string_view before, auto element) {
  text.text(text.size() == 0 ? "" : ",").text(name.column).text(before);
  if constexpr (std::is_integral_v<decltype(element)>) {
    text.number(element);
  } else {
    text.text(element);
  }
  text.text(name.unit.empty() ? "" : "_").text(name.unit);
}

// Writes the column names of a field: one, or one for each axis or joint.
class ColumnNames {
 public:
  ColumnNames(TextBuffer& text, std::size_t joints) : text_(&text), joints_(joints) {}

  void operator()(const FieldName& name, const auto& /*field*/) const {
    put_column(*text_, name, "", std::string_view{});
  }
  void operator()(const FieldName& name, const Triple& /*field*/) const {
    for (const std::string_view axis : kAxisNames) {
      put_column(*text_, name, "_", axis);
    }
  }
  void operator()(const FieldName& name, const EnergyLedger& /*field*/) const {
    for (const std::string_view source : kEnergySourceNames) {
      put_column(*text_, name, "_", source);
    }
  }
  void operator()(const FieldName& name,
                  const std::array<double, drivers::kMaxJoints>& /*field*/) const {
    for (std::size_t i = 1; i <= joints_; ++i) {
      put_column(*text_, name, "", i);
    }
  }

 private:
  TextBuffer* text_;
  std::size_t joints_;
};

// Writes the values of a field, in the order of ColumnNames.
class ColumnValues {
 public:
  ColumnValues(TextBuffer& text, std::size_t joints) : text_(&text), joints_(joints) {}

  template <class Field>
  void operator()(const FieldName& name, const Field& field) {
    if constexpr (std::is_same_v<Field, Mode>) {
      separate().text(mode_name(field));
    } else if constexpr (std::is_same_v<Field, Request>) {
      separate().text(kRequestNames[static_cast<std::size_t>(field)]);
    } else if constexpr (std::is_enum_v<Field>) {
      separate().number(static_cast<unsigned>(field));
    } else if (name.name == "state_hash") {
      separate().hex(static_cast<std::uint64_t>(field));
    } else {
      separate().number(field);
    }
  }
  void operator()(const FieldName& /*name*/, const Triple& field) { put_all(field); }
  void operator()(const FieldName& /*name*/, const EnergyLedger& field) { put_all(field); }
  void operator()(const FieldName& /*name*/, const std::array<double, drivers::kMaxJoints>& field) {
    put_all(std::span(field).first(joints_));
  }

 private:
  // Writes the comma before a value.
  TextBuffer& separate() {
    text_->text(first_ ? "" : ",");
    first_ = false;
    return *text_;
  }
  void put_all(std::span<const double> values) {
    for (const double value : values) {
      separate().number(value);
    }
  }

  TextBuffer* text_;
  std::size_t joints_;
  bool first_ = true;
};

}  // namespace

int CsvWriter::open(const char* path, std::size_t joints, IfThere if_there) {
  joints_ = std::min(joints, drivers::kMaxJoints);
  text_.clear();
  if (const int error = sink_.open(path, if_there); error != 0) {
    return error;
  }
  const RecordedTick any;
  visit_tick_fields(any, ColumnNames(text_, joints_));
  text_.text("\n");
  flush();
  return sink_.error();
}

void CsvWriter::add(const RecordedTick& tick) {
  if (text_.room_left() < kLongestLine) {
    flush();
  }
  visit_tick_fields(tick, ColumnValues(text_, joints_));
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
