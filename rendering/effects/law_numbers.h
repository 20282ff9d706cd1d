// A law as a list of numbers, in the order of its fields. An image stores a law without a table of
// its own by its name and these.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "rendering/effects/registered_laws.h"

namespace tactus::rendering {

inline constexpr std::size_t kMostLawNumbers = 48;

struct LawNumbers {
  std::array<double, kMostLawNumbers> values{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const double> all() const { return std::span(values).first(count); }
};

std::string_view name_of(const EffectLaw& law);

LawNumbers numbers_of(const EffectLaw& law);

// Returns the law of that name with those numbers, or nothing if it has another count of numbers or
// one is out of range. The name must be one of kEffectLawNames.
std::optional<EffectLaw> law_of(std::string_view name, std::span<const double> numbers);

}  // namespace tactus::rendering
