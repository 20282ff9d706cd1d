#include "host_tools/bake/mesh_file/mesh_text.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host_tools/input_error.h"

namespace tactus::host {

std::optional<double> any_number(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  if (error == std::errc::result_out_of_range) {
    // Only a negative exponent makes a number too small.
    const bool is_small =
        word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
    return is_small ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return value;
}

void MeshText::fail(std::size_t line, const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}; repair or export the mesh again", file_, line, what));
}

std::string FilePart::name() const {
  return fmt::format("{} {}", kind, index);
}

std::string_view MeshText::require_line(std::string_view what) {
  const std::optional<std::string_view> line = next_line();
  if (!line) {
    fail(fmt::format("the file ends before {}", what));
  }
  return *line;
}

std::string_view MeshText::require_line(const FilePart& part, std::size_t total) {
  const std::optional<std::string_view> line = next_line();
  if (!line) {
    fail(fmt::format("the file ends before {} of {}", part.name(), total));
  }
  return *line;
}

double MeshText::require_number(std::string_view& line, const FilePart& part) const {
  const std::string_view word = next_word(line);
  const std::optional<double> value = any_number(word);
  if (!value) {
    fail(word.empty()
             ? fmt::format("{} has too few numbers", part.name())
             : fmt::format("{}: '{}' is not a number{}", part.name(), word,
                           word.find(',') == std::string_view::npos
                               ? ""
                               : "; numbers need a decimal point and blanks between them"));
  }
  if (!std::isfinite(*value)) {
    fail(fmt::format("{} is not finite ({})", part.name(), word));
  }
  return *value;
}

Vec3 MeshText::require_position(std::string_view& line, const FilePart& part) const {
  Vec3 position;
  for (double& coordinate : position) {
    coordinate = require_number(line, part);
  }
  return position;
}

std::int64_t MeshText::require_integer(std::string_view word, const FilePart& part) const {
  const std::optional<std::int64_t> value = to_number<std::int64_t>(word);
  if (!value) {
    fail(word.empty() ? fmt::format("{} has too few numbers", part.name())
                      : fmt::format("{}: '{}' is not a whole number", part.name(), word));
  }
  return *value;
}

std::uint32_t MeshText::require_index(std::string_view word, std::size_t vertices,
                                      const FilePart& part) const {
  const std::int64_t index = require_integer(word, part);
  if (index < 0 || index >= static_cast<std::int64_t>(vertices)) {
    fail(fmt::format("{} names vertex {}, but vertices go from 0 to {}", part.name(), index,
                     static_cast<std::int64_t>(vertices) - 1));
  }
  return static_cast<std::uint32_t>(index);
}

std::optional<std::string> MeshText::note_on_rest(const std::string& what) {
  if (!next_line()) {
    return std::nullopt;
  }
  const std::size_t first = number();
  std::size_t count = 1;
  while (next_line()) {
    ++count;
  }
  return fmt::format(
      "{}:{}: {} lines after {} are left out; correct the counts if they belong to "
      "the mesh",
      file_, first, count, what);
}

}  // namespace tactus::host
