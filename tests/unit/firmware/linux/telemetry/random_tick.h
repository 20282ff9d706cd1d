// A recorded tick full of random bits, for tests of what carries it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <type_traits>

#include "firmware/telemetry/record_fields.h"

namespace tactus::firmware {

template <class Number>
void fill_randomly(std::mt19937_64& random, Number& number) {
  if constexpr (std::is_enum_v<Number>) {
    number = static_cast<Number>(random() % 4);
  } else if constexpr (std::is_floating_point_v<Number>) {
    do {
      number = std::bit_cast<double>(random());
    } while (std::isnan(number));
  } else {
    number = static_cast<Number>(random());
  }
}

template <class Number, std::size_t N>
void fill_randomly(std::mt19937_64& random, std::array<Number, N>& numbers) {
  for (Number& number : numbers) {
    fill_randomly(random, number);
  }
}

inline RecordedTick random_tick(std::mt19937_64& random) {
  RecordedTick tick;
  visit_tick_fields(tick, [&](const FieldName&, auto& field) { fill_randomly(random, field); });
  tick.joint_count = drivers::kMaxJoints;
  return tick;
}

// Every field by its bits: infinities and negative zero count.
inline void expect_equal(const RecordedTick& expected, const RecordedTick& actual) {
  std::array<bool, 256> same{};
  std::size_t count = 0;
  visit_tick_fields(expected, [&, base = &expected](const FieldName&, const auto& field) {
    const auto bytes = std::as_bytes(std::span(&field, 1));
    const auto offset = bytes.data() - std::as_bytes(std::span(base, 1)).data();
    const auto there = std::as_bytes(std::span(&actual, 1));
    same[count] =
        std::ranges::equal(bytes, there.subspan(static_cast<std::size_t>(offset), bytes.size()));
    ++count;
  });
  count = 0;
  visit_tick_fields(expected, [&](const FieldName& name, const auto&) {
    EXPECT_TRUE(same[count]) << name.name;
    ++count;
  });
}

}  // namespace tactus::firmware
