// Advises a user who wrote a key that does not exist. TomlSection calls it for every unknown key.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// A key that a section of a TOML file may have.
struct KeySpec {
  // The whole key, such as radius_m.
  std::string_view name;
  // The suffix that names the unit, such as m; empty for a key without a unit.
  std::string_view unit;

  // Returns the key without its unit: "radius" of radius_m.
  [[nodiscard]] std::string_view base() const {
    return unit.empty() ? name : name.substr(0, name.size() - unit.size() - 1);
  }
};

// Returns the unit in words, such as "metres"; empty for an unknown unit.
std::string_view unit_in_words(std::string_view unit);

// Returns the remedy for an unknown key, by the first of these that applies: the key with the right
// unit and the numbers converted, the nearest existing key, the list of all keys. `values` are the
// numbers that the user gave, none if there were none; `is_array` says in which form to write them.
std::string advise(std::string_view unknown, std::span<const KeySpec> known,
                   std::span<const double> values, bool is_array);

}  // namespace tactus::host
