// One table of a TOML file, read with errors that name the file, the line and the remedy.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/toml/key_advice.h"

// Defined by toml++, which only the .cpp files see: it is a quarter of a million lines to compile.
// NOLINTBEGIN(readability-identifier-naming)
namespace toml::inline v3 {
class table;
class node;
}  // namespace toml::inline v3
// NOLINTEND(readability-identifier-naming)

namespace tactus::host {

struct NumberRange {
  double lowest = std::numeric_limits<double>::lowest();
  bool lowest_allowed = true;
};
inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kZeroOrMore{.lowest = 0.0, .lowest_allowed = true};
inline constexpr NumberRange kAboveZero{.lowest = 0.0, .lowest_allowed = false};

// Each reader gives nothing when the key is absent, and throws InputError when it holds something
// else than it should. The table and the strings behind the views must outlive the section.
class TomlSection {
 public:
  // Throws InputError, with advice, on any key that is not in `keys`. `title` names the section in
  // messages: "[tool]".
  TomlSection(const toml::table& table, std::string_view file, std::string title,
              std::span<const KeySpec> keys);

  [[nodiscard]] std::optional<double> number(std::string_view key, NumberRange range) const;
  // Returns a whole number from `least` to `most`; nothing if the key is absent.
  [[nodiscard]] std::optional<std::size_t> count(std::string_view key, std::size_t most,
                                                 std::size_t least = 1) const;
  [[nodiscard]] std::optional<bool> flag(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
  [[nodiscard]] std::optional<std::vector<double>> numbers(std::string_view key,
                                                           std::size_t count) const;
  [[nodiscard]] const toml::table* table(std::string_view key) const;

  [[nodiscard]] bool has(std::string_view key) const;
  // Returns the line of the key's value, or of the section when the key is absent.
  [[nodiscard]] std::size_t line(std::string_view key) const;
  [[nodiscard]] const std::string& title() const { return title_; }

  // Throws InputError "file:line: title: what".
  [[noreturn]] void fail(std::string_view key, const std::string& what) const;

 private:
  double checked(const toml::node& node, std::string_view key, NumberRange range) const;
  void reject_unknown(std::span<const KeySpec> keys) const;

  const toml::table& table_;
  std::string_view file_;
  std::string title_;
};

}  // namespace tactus::host
