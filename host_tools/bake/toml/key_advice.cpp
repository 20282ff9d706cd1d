#include "host_tools/bake/toml/key_advice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <numbers>

#include "hal/angle.h"
#include "host_tools/nearest_name.h"

namespace tactus::host {
namespace {

// A suffix and its unit in words.
struct UnitWords {
  std::string_view unit;
  std::string_view words;
};

constexpr std::array kUnitWords{
    UnitWords{"m", "metres"},
    UnitWords{"mm", "millimetres"},
    UnitWords{"N_per_m", "newtons per metre"},
    UnitWords{"Ns_per_m", "newton seconds per metre"},
    UnitWords{"s_per_m", "seconds per metre"},
    UnitWords{"m_per_s", "metres per second"},
    UnitWords{"kg", "kilograms"},
    UnitWords{"Pa", "pascals"},
    UnitWords{"deg", "degrees"},
    UnitWords{"N", "newtons"},
    UnitWords{"Hz", "hertz"},
    UnitWords{"hz", "hertz"},
    UnitWords{"Ns2_per_m2", "newton seconds squared per metre squared"},
    UnitWords{"rad", "radians"},
    UnitWords{"rad_per_s", "radians per second"},
    UnitWords{"Nm", "newton metres"},
    UnitWords{"per_Nm", "units for each newton metre"},
    UnitWords{"N_per_s", "newtons per second"},
    UnitWords{"m_per_s2", "metres per second squared"},
    UnitWords{"A", "amperes"},
    UnitWords{"s", "seconds"},
    UnitWords{"ms", "milliseconds"},
    UnitWords{"us", "microseconds"},
    UnitWords{"ns", "nanoseconds"},
};

// A unit that users write instead of `unit`: one of `other` is `factor` of `unit`. Other units are
// compared in lower case.
struct OtherUnit {
  std::string_view other;
  std::string_view unit;
  double factor;
};

constexpr std::array kOtherUnits{
    OtherUnit{"mm", "m", 1e-3},
    OtherUnit{"cm", "m", 1e-2},
    OtherUnit{"dm", "m", 1e-1},
    OtherUnit{"um", "m", 1e-6},
    OtherUnit{"km", "m", 1e3},
    OtherUnit{"in", "m", 0.0254},
    OtherUnit{"inch", "m", 0.0254},
    OtherUnit{"ft", "m", 0.3048},
    OtherUnit{"meter", "m", 1.0},
    OtherUnit{"meters", "m", 1.0},
    OtherUnit{"metres", "m", 1.0},
    OtherUnit{"m", "mm", 1e3},
    OtherUnit{"cm", "mm", 1e1},
    OtherUnit{"um", "mm", 1e-3},
    OtherUnit{"n_per_mm", "N_per_m", 1e3},
    OtherUnit{"n_per_cm", "N_per_m", 1e2},
    OtherUnit{"n_per_um", "N_per_m", 1e6},
    OtherUnit{"kn_per_m", "N_per_m", 1e3},
    OtherUnit{"n_m", "N_per_m", 1.0},
    OtherUnit{"ns_per_mm", "Ns_per_m", 1e3},
    OtherUnit{"ns_per_cm", "Ns_per_m", 1e2},
    OtherUnit{"n_per_m_per_s", "Ns_per_m", 1.0},
    OtherUnit{"n_s_per_m", "Ns_per_m", 1.0},
    OtherUnit{"kg_per_s", "Ns_per_m", 1.0},
    OtherUnit{"ns_m", "Ns_per_m", 1.0},
    OtherUnit{"s_per_mm", "s_per_m", 1e3},
    OtherUnit{"mm_per_s", "m_per_s", 1e-3},
    OtherUnit{"cm_per_s", "m_per_s", 1e-2},
    OtherUnit{"um_per_s", "m_per_s", 1e-6},
    OtherUnit{"g", "kg", 1e-3},
    OtherUnit{"kpa", "Pa", 1e3},
    OtherUnit{"mpa", "Pa", 1e6},
    OtherUnit{"gpa", "Pa", 1e9},
    OtherUnit{"n_per_mm2", "Pa", 1e6},
    OtherUnit{"rad", "deg", hal::degrees_of(1.0)},
    OtherUnit{"deg", "rad", hal::radians_of(1.0)},
    OtherUnit{"degrees", "rad", hal::radians_of(1.0)},
    OtherUnit{"turn", "rad", 2.0 * std::numbers::pi},
    OtherUnit{"rev", "rad", 2.0 * std::numbers::pi},
    OtherUnit{"deg_per_s", "rad_per_s", hal::radians_of(1.0)},
    OtherUnit{"turn_per_s", "rad_per_s", 2.0 * std::numbers::pi},
    OtherUnit{"rev_per_s", "rad_per_s", 2.0 * std::numbers::pi},
    OtherUnit{"rpm", "rad_per_s", std::numbers::pi / 30.0},
    OtherUnit{"mnm", "Nm", 1e-3},
    OtherUnit{"ncm", "Nm", 1e-2},
    OtherUnit{"ma", "A", 1e-3},
    OtherUnit{"ms", "s", 1e-3},
    OtherUnit{"us", "s", 1e-6},
    OtherUnit{"s", "ms", 1e3},
    OtherUnit{"ms", "us", 1e3},
    OtherUnit{"us", "ns", 1e3},
    OtherUnit{"turn", "deg", 360.0},
    OtherUnit{"turns", "deg", 360.0},
    OtherUnit{"degrees", "deg", 1.0},
    OtherUnit{"mn", "N", 1e-3},
    OtherUnit{"kn", "N", 1e3},
    OtherUnit{"newton", "N", 1.0},
    OtherUnit{"newtons", "N", 1.0},
    OtherUnit{"khz", "Hz", 1e3},
    OtherUnit{"rpm", "Hz", 1.0 / 60.0},
    OtherUnit{"khz", "hz", 1e3},
};

// Returns the text in lower case.
std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

// Returns the key with its unit in words.
std::string named(const KeySpec& key) {
  return key.unit.empty() ? std::string(key.name)
                          : fmt::format("{} ({})", key.name, unit_in_words(key.unit));
}

// Returns the values to write; ten digits round off what the conversion's arithmetic left behind.
std::string converted(std::span<const double> values, double factor, bool is_array) {
  std::vector<std::string> texts;
  for (const double value : values) {
    texts.push_back(fmt::format("{:.10g}", value * factor));
  }
  return is_array ? fmt::format("[{}]", fmt::join(texts, ", ")) : texts.front();
}

// Returns advice for a key that is right but for its unit; nothing if no known unit explains the
// suffix.
std::optional<std::string> advise_on_unit(std::string_view unknown, std::span<const KeySpec> known,
                                          std::span<const double> values, bool is_array) {
  for (const KeySpec& key : known) {
    const std::string start = std::string(key.base()) + "_";
    if (key.unit.empty() || !unknown.starts_with(start)) {
      continue;
    }
    const std::string suffix = lower(unknown.substr(start.size()));
    const auto unit = std::ranges::find_if(
        kOtherUnits, [&](const OtherUnit& u) { return u.other == suffix && u.unit == key.unit; });
    if (unit == kOtherUnits.end()) {
      continue;
    }
    const std::string wanted =
        fmt::format("wrong unit, {} is in {}", key.base(), unit_in_words(key.unit));
    return values.empty() ? fmt::format("{}; write {}", wanted, key.name)
                          : fmt::format("{}; write {} = {}", wanted, key.name,
                                        converted(values, unit->factor, is_array));
  }
  return std::nullopt;
}

// Returns the edit distance to the whole key or to the key without its unit, whichever is smaller.
std::size_t distance_to(const KeySpec& key, std::string_view unknown) {
  const std::string text = lower(unknown);
  return std::min(edit_distance(text, lower(key.name)), edit_distance(text, lower(key.base())));
}

}  // namespace

std::string_view unit_in_words(std::string_view unit) {
  const auto found = std::ranges::find(kUnitWords, unit, &UnitWords::unit);
  return found == kUnitWords.end() ? std::string_view{} : found->words;
}

std::string advise(std::string_view unknown, std::span<const KeySpec> known,
                   std::span<const double> values, bool is_array) {
  if (const auto unit_advice = advise_on_unit(unknown, known, values, is_array)) {
    return *unit_advice;
  }
  const auto nearest = std::ranges::min_element(
      known, {}, [&](const KeySpec& key) { return distance_to(key, unknown); });
  // A third of the letters wrong is still the same word.
  if (nearest != known.end() &&
      distance_to(*nearest, unknown) <= std::max<std::size_t>(2, unknown.size() / 3)) {
    return fmt::format("did you mean {}?", named(*nearest));
  }
  std::vector<std::string_view> names;
  std::ranges::transform(known, std::back_inserter(names), &KeySpec::name);
  return fmt::format("the keys here are {}", fmt::join(names, ", "));
}

}  // namespace tactus::host
