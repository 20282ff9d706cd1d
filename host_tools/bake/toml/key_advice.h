// Suggests the right key to a user who wrote one that does not exist.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// A key that a section of a TOML file may hold. `unit` is the suffix that says the unit, empty for
// keys without one: radius_m has the unit "m".
struct KeySpec {
  std::string_view name;
  std::string_view unit;

  // "radius" of radius_m.
  [[nodiscard]] std::string_view base() const {
    return unit.empty() ? name : name.substr(0, name.size() - unit.size() - 1);
  }
};

// The unit in words, "metres"; empty without one.
std::string_view unit_in_words(std::string_view unit);

// The remedy for an unknown key, without the key itself: a known unit in place of ours (with the
// numbers converted), a missing unit, a near miss, or the list of what there is. `values` are the
// key's numbers, none if it holds none; `is_array` says how to write them.
std::string advise(std::string_view unknown, std::span<const KeySpec> known,
                   std::span<const double> values, bool is_array);

}  // namespace tactus::host
