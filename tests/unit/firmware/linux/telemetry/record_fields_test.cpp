#include "firmware/telemetry/record_fields.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace tactus::firmware {
namespace {

TEST(RecordFields, CoverTheWholeRecord) {
  // The bytes that the compiler leaves empty between fields. A field without a line in
  // record_fields.h makes the number larger.
  constexpr std::size_t kPadding = 26;
  RecordedTick tick;
  std::size_t bytes = 0;
  visit_tick_fields(tick, [&](const FieldName&, const auto& field) { bytes += sizeof(field); });
  EXPECT_EQ(sizeof(tick) - bytes, kPadding) << "record_fields.h says what a new field needs";
}

TEST(RecordFields, HaveNamesAndColumnsOfTheirOwn) {
  const RecordedTick tick;
  std::set<std::string_view> names;
  std::set<std::string> columns;
  visit_tick_fields(tick, [&](const FieldName& name, const auto&) {
    EXPECT_TRUE(names.insert(name.name).second) << name.name;
    EXPECT_TRUE(columns.insert(std::string(name.column) + '_' + std::string(name.unit)).second)
        << name.column;
  });
}

}  // namespace
}  // namespace tactus::firmware
