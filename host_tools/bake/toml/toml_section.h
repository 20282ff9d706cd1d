// Reads one table of a TOML file, with errors that name the file, the line and the remedy. The
// readers of scenes and devices use it for every table.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/toml/key_advice.h"
#include "rendering/geometry/vector.h"

// Defined by toml++, which only the .cpp files see: it is a quarter of a million lines to compile.
// NOLINTBEGIN(readability-identifier-naming)
namespace toml::inline v3 {
class table;
class node;
}  // namespace toml::inline v3
// NOLINTEND(readability-identifier-naming)

namespace tactus::host {

// The numbers that a key accepts: from `lowest` upwards, or above it if `lowest` itself is
// excluded.
struct NumberRange {
  // The bound, and whether the bound itself is accepted.
  double lowest = std::numeric_limits<double>::lowest();
  bool lowest_allowed = true;
};
// The ranges that most keys have.
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kZeroOrMore{.lowest = 0.0, .lowest_allowed = true};
inline constexpr NumberRange kAboveZero{.lowest = 0.0, .lowest_allowed = false};

// Each reader function returns nothing if the key is absent, and throws InputError if the key holds
// something else than it should. The table and the strings behind the views must outlive the
// section.
class TomlSection {
 public:
  // Throws InputError, with advice, for any key that is not in `keys`. `title` names the section in
  // messages, for example "[tool]".
  TomlSection(const toml::table& table, std::string_view file, std::string title,
              std::span<const KeySpec> keys);

  // Returns a finite number in the range.
  [[nodiscard]] std::optional<double> number(std::string_view key, NumberRange range) const;
  // Returns a whole number from `least` to `most`.
  [[nodiscard]] std::optional<std::size_t> count(std::string_view key, std::size_t most,
                                                 std::size_t least = 1) const;
  // Returns true or false.
  [[nodiscard]] std::optional<bool> flag(std::string_view key) const;
  // Returns text that is not empty and has no control characters.
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
  // Returns an array of exactly `count` finite numbers.
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key,
                                                           std::size_t count) const;
  // Returns an array of three finite numbers as a vector.
  [[nodiscard]] std::optional<Vec3> vector(std::string_view key) const;
  // Returns an array of finite numbers, however many.
  [[nodiscard]] std::optional<std::vector<double>> list(std::string_view key) const;
  // Returns a table inside this one; nullptr if the key is absent.
  [[nodiscard]] const toml::table* table(std::string_view key) const;

  // Returns true if the key is present, whatever it holds.
  [[nodiscard]] bool has(std::string_view key) const;
  // Returns the line of the key's value, or the section's first line if the key is absent.
  [[nodiscard]] std::size_t line(std::string_view key) const;
  // Returns the name of the section for messages.
  [[nodiscard]] const std::string& title() const { return title_; }

  // Throws InputError "file:line: title: what" at the key's line.
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;

 private:
  // Returns the number of a node. Throws InputError if it is none, not finite or out of range.
  double checked(const toml::node& node, std::string_view key, NumberRange range) const;
  // Throws InputError with advice at the first key that is not in `keys`.
  void reject_unknown(std::span<const KeySpec> keys) const;

  const toml::table& table_;
  std::string_view file_;
  std::string title_;
};

}  // namespace tactus::host
