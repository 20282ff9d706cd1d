#include "host_tools/remote/reply_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

namespace tactus::host {
namespace {

using Json = nlohmann::ordered_json;

// Fields of a parameter beside its own name; every other field of its line but the tick is its name
// and value.
constexpr std::array<std::string_view, 5> kOfParameter{"least", "greatest", "unit", "choices",
                                                       "object"};
// Values that come last and may have blanks: files, and the name of an object.
constexpr std::array<std::string_view, 3> kRests{"scene", "file", "object"};

template <std::size_t kCount>
bool is_one_of(const std::array<std::string_view, kCount>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Returns the end of a value that begins at `begin` of the line.
std::size_t end_of_value(std::string_view line, std::string_view name, std::size_t begin) {
  if (is_one_of(kRests, name)) {
    return line.size();
  }
  if (begin < line.size() && line[begin] == '"') {
    const std::size_t quote = line.find('"', begin + 1);
    return quote == std::string_view::npos ? line.size() : quote + 1;
  }
  return std::min(line.find(' ', begin), line.size());
}

std::string without_quotes(std::string_view value) {
  const bool is_quoted = value.size() >= 2 && value.front() == '"' && value.back() == '"';
  return std::string(is_quoted ? value.substr(1, value.size() - 2) : value);
}

std::vector<std::string> split_at_commas(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// Returns the number that the whole text is, or the text.
Json number_or_text(const std::string& text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || rest != end) {
    return text;
  }
  const Json parsed = Json::parse(text, nullptr, false);
  return parsed.is_number() ? parsed : Json(number);
}

Json value_of(const ReplyField& field) {
  if (field.name == "faults") {
    return field.value == "none" ? Json::array() : Json(split_at_commas(field.value));
  }
  if (field.name == "choices") {
    return split_at_commas(field.value);
  }
  const bool is_text = is_one_of(kRests, field.name) || field.name == "unit";
  return is_text ? Json(field.value) : number_or_text(field.value);
}

// A parameter of a line.
struct ParameterLine {
  ReplyField named;
  std::vector<ReplyField> others;

  [[nodiscard]] std::string other(std::string_view name) const {
    const auto found = std::ranges::find(others, name, &ReplyField::name);
    return found == others.end() ? "" : found->value;
  }
};

std::optional<ParameterLine> parameter_of(std::string_view line) {
  ParameterLine parameter;
  for (ReplyField& field : fields_of(line)) {
    if (is_one_of(kOfParameter, field.name)) {
      parameter.others.push_back(std::move(field));
    } else if (field.name != "tick") {
      parameter.named = std::move(field);
    }
  }
  return parameter.named.name.empty() || parameter.others.empty() ? std::nullopt
                                                                  : std::optional(parameter);
}

void add_parameter(const ParameterLine& parameter, Json& object) {
  object["name"] = parameter.named.name;
  object["value"] = number_or_text(parameter.named.value);
  for (const ReplyField& field : parameter.others) {
    object[field.name] = value_of(field);
  }
}

}  // namespace

std::vector<ReplyField> fields_of(std::string_view line) {
  std::vector<ReplyField> fields;
  for (std::size_t begin = 0; begin < line.size();) {
    const std::size_t word_end = std::min(line.find(' ', begin), line.size());
    const std::size_t equals = line.find('=', begin);
    if (equals == std::string_view::npos || equals >= word_end) {
      begin = word_end + 1;
      continue;
    }
    const std::string_view name = line.substr(begin, equals - begin);
    const std::size_t end = end_of_value(line, name, equals + 1);
    fields.push_back(
        {std::string(name), without_quotes(line.substr(equals + 1, end - equals - 1))});
    begin = end + 1;
  }
  return fields;
}

std::optional<std::string> field_of(std::string_view line, std::string_view name) {
  const std::vector<ReplyField> fields = fields_of(line);
  const auto found = std::ranges::find(fields, name, &ReplyField::name);
  return found == fields.end() ? std::nullopt : std::optional(found->value);
}

Json json_of(const Reply& reply) {
  const std::string_view text = reply.text;
  const std::size_t word = text.find(' ') + 1;
  const std::size_t word_end = word == 0 ? word : text.find_first_of(" :", word);
  Json object;
  object["ok"] = reply.is_ok;
  if (word != 0) {
    object["command"] = text.substr(word, word_end - word);
  }
  if (!reply.is_ok) {
    object["text"] = text;
    return object;
  }
  const auto parameter = parameter_of(text);
  for (const ReplyField& field : fields_of(text)) {
    if (!parameter || field.name == "tick") {
      object[field.name] = value_of(field);
    }
  }
  if (parameter) {
    add_parameter(*parameter, object);
  }
  for (const std::string& line : reply.lines) {
    if (const auto listed = parameter_of(line)) {
      add_parameter(*listed, object["parameters"].emplace_back());
    }
  }
  return object;
}

std::string parameter_table(const std::vector<std::string>& lines) {
  std::vector<std::array<std::string, 4>> rows{{"parameter", "value", "unit", "range"}};
  std::array<std::size_t, 4> widths{};
  for (const std::string& line : lines) {
    if (const auto parameter = parameter_of(line)) {
      const std::string choices = parameter->other("choices");
      const std::string unit = parameter->other("unit");
      const std::string object = parameter->other("object");
      const std::string range =
          choices.empty()
              ? fmt::format("{} to {}", parameter->other("least"), parameter->other("greatest"))
              : fmt::format("{}", fmt::join(split_at_commas(choices), ", "));
      rows.push_back({parameter->named.name, parameter->named.value, unit == "1" ? "" : unit,
                      object.empty() ? range : fmt::format("{}   ({})", range, object)});
    }
  }
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string table;
  for (const auto& row : rows) {
    table += fmt::format("{:<{}}  {:>{}}  {:<{}}  {}\n", row[0], widths[0], row[1], widths[1],
                         row[2], widths[2], row[3]);
  }
  return table;
}

}  // namespace tactus::host
