#include "host_tools/bake/toml/toml_section.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the numbers of a value or an array, for advice that converts units.
std::vector<double> numbers_in(const toml::node& node) {
  std::vector<double> values;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) {
      if (const std::optional<double> value = element.value<double>()) {
        values.push_back(*value);
      }
    }
  } else if (const std::optional<double> value = node.value<double>()) {
    values.push_back(*value);
  }
  return values;
}

}  // namespace

TomlSection::TomlSection(const toml::table& table, std::string_view file, std::string title,
                         std::span<const KeySpec> keys)
    : table_(table), file_(file), title_(std::move(title)) {
  reject_unknown(keys);
}

void TomlSection::reject_unknown(std::span<const KeySpec> keys) const {
  for (const auto& [key, node] : table_) {
    if (std::ranges::find(keys, key.str(), &KeySpec::name) != keys.end()) {
      continue;
    }
    const std::vector<double> values = numbers_in(node);
    throw InputError(fmt::format("{}:{}: {}: unknown key '{}'; {}", file_, key.source().begin.line,
                                 title_, key.str(),
                                 advise(key.str(), keys, values, node.is_array())));
  }
}

bool TomlSection::has(std::string_view key) const {
  return table_.contains(key);
}

std::size_t TomlSection::line(std::string_view key) const {
  const toml::node* node = table_.get(key);
  return node != nullptr ? node->source().begin.line : table_.source().begin.line;
}

void TomlSection::fail(std::string_view key, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}: {}", file_, line(key), title_, what));
}

double TomlSection::checked(const toml::node& node, std::string_view key, NumberRange range) const {
  const std::optional<double> number = node.is_number() ? node.value<double>() : std::nullopt;
  if (!number) {
    fail(key,
         fmt::format("{} must be a number; write it without quotes, as in {} = 0.5", key, key));
  }
  const double value = *number;
  if (!std::isfinite(value)) {
    fail(key, fmt::format("{} is {}; write a finite number", key, value));
  }
  if (value < range.lowest || (value == range.lowest && !range.lowest_allowed)) {
    fail(key, fmt::format("{} is {}; write a number {} {}", key, value,
                          range.lowest_allowed ? "from" : "above", range.lowest));
  }
  return value;
}

std::optional<double> TomlSection::number(std::string_view key, NumberRange range) const {
  const toml::node* node = table_.get(key);
  return node == nullptr ? std::nullopt : std::optional(checked(*node, key, range));
}

std::optional<std::size_t> TomlSection::count(std::string_view key, std::size_t most,
                                              std::size_t least) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  const std::optional<std::int64_t> value = node->value_exact<std::int64_t>();
  if (!value || *value < 0 || static_cast<std::size_t>(*value) < least ||
      static_cast<std::size_t>(*value) > most) {
    fail(key, fmt::format("{} must be a whole number from {} to {}; write {} = 1", key, least, most,
                          key));
  }
  return static_cast<std::size_t>(*value);
}

std::optional<bool> TomlSection::flag(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  const std::optional<bool> value = node->value_exact<bool>();
  if (!value) {
    fail(key, fmt::format("{} must be true or false; write {} = true", key, key));
  }
  return value;
}

std::optional<std::string> TomlSection::text(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  const std::optional<std::string> value = node->value_exact<std::string>();
  if (!value || value->empty()) {
    fail(key, fmt::format("{} must be text; write it in quotes, as in {} = \"...\"", key, key));
  }
  if (std::ranges::any_of(*value, [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    fail(key, fmt::format("{} holds a control character; leave it out", key));
  }
  return value;
}

std::optional<std::vector<double>> TomlSection::numbers(std::string_view key,
                                                        std::size_t count) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != count) {
    std::string example = count == 3 ? "0.0" : "1.0";
    for (std::size_t i = 1; i < count; ++i) {
      example += ", 0.0";
    }
    fail(key, fmt::format("{} must be {} numbers; write {} = [{}]", key, count, key,
                          count == 2 ? "0.0, 1.0" : example));
  }
  std::vector<double> values;
  for (const toml::node& element : *array) {
    values.push_back(checked(element, key, kAnyNumber));
  }
  return values;
}

std::optional<Vec3> TomlSection::vector(std::string_view key) const {
  const auto values = numbers(key, 3);
  return values ? std::optional(Vec3((*values)[0], (*values)[1], (*values)[2])) : std::nullopt;
}

std::optional<std::vector<double>> TomlSection::list(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr) {
    fail(key, fmt::format("{} must be a list of numbers; write {} = [1.0, 2.0, 3.0]", key, key));
  }
  return numbers(key, array->size());
}

const toml::table* TomlSection::table(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node != nullptr && !node->is_table()) {
    fail(key, fmt::format("{} must be a table; write {} = {{ ... }}", key, key));
  }
  return node == nullptr ? nullptr : node->as_table();
}

}  // namespace tactus::host
