#include "host_tools/benchmark/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "host_tools/csv/csv_text.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"

namespace tactus::host {
namespace {

// One row with the names of its columns.
class Row {
 public:
  Row(const std::vector<std::string>& names, std::vector<std::string> fields, std::string where)
      : names_(names), fields_(std::move(fields)), where_(std::move(where)) {
    if (fields_.size() != names_.size()) {
      throw InputError(fmt::format("{}: {} fields, where the header names {}", where_,
                                   fields_.size(), names_.size()));
    }
  }

  // Returns the field of a column; nothing if it is empty or there is no such column.
  [[nodiscard]] std::optional<std::string> text(std::string_view name) const {
    const auto at = std::ranges::find(names_, name);
    if (at == names_.end()) {
      return std::nullopt;
    }
    const std::string& field = fields_[static_cast<std::size_t>(at - names_.begin())];
    return field.empty() ? std::nullopt : std::optional(field);
  }

  [[nodiscard]] std::optional<double> number(std::string_view name) const {
    const auto field = text(name);
    if (!field) {
      return std::nullopt;
    }
    const auto value = csv_number(*field);
    if (!value) {
      throw InputError(fmt::format("{}: column {}: '{}' is no number", where_, name, *field));
    }
    return value->value;
  }

  [[nodiscard]] double needed(std::string_view name) const {
    const auto value = number(name);
    if (!value) {
      throw InputError(fmt::format("{}: no column {}; these are no figures of tactus bench touch",
                                   where_, name));
    }
    return *value;
  }

 private:
  const std::vector<std::string>& names_;
  std::vector<std::string> fields_;
  std::string where_;
};

bool is_same(const FigureRow& a, const FigureRow& b) {
  return a.mesh == b.mesh && a.triangles == b.triangles && a.radius_mm == b.radius_mm &&
         a.motion == b.motion;
}

// Runs one program and returns its rows.
std::vector<FigureRow> run(const std::filesystem::path& program, const std::string& words,
                           const std::filesystem::path& file) {
  const std::string command =
      fmt::format("{} bench touch --runs 1 {}", shell_quoted(program), words);
  if (!command_succeeds(fmt::format("{} --csv {}", command, shell_quoted(file)))) {
    throw InputError(fmt::format("the program failed; see why: {}", command));
  }
  return read_figures(file);
}

}  // namespace

std::vector<FigureRow> read_figures(const std::filesystem::path& file) {
  const std::string content = read_file(file);
  CsvText text(content);
  std::vector<std::string> names;
  std::vector<FigureRow> rows;
  while (const std::vector<std::string>* fields = text.next()) {
    if (fields->front().starts_with('#')) {
      continue;
    }
    if (names.empty()) {
      names = *fields;
      continue;
    }
    const Row row(names, *fields, fmt::format("{}:{}", file.string(), text.number()));
    rows.push_back({.mesh = row.text("mesh").value_or(""),
                    .triangles = row.number("triangles").value_or(0.0),
                    .radius_mm = row.needed("radius_mm"),
                    .motion = row.text("motion").value_or("jumps"),
                    .median_ns = row.needed("median_ns"),
                    .p99_ns = row.needed("p99_ns"),
                    .p999_ns = row.needed("p999_ns"),
                    .instructions = row.number("instructions_median"),
                    .late_ticks = row.number("late_ticks")});
  }
  if (rows.empty()) {
    throw InputError(fmt::format("{}: no figures in it", file.string()));
  }
  return rows;
}

void keep_least(std::vector<FigureRow>& rows, const std::vector<FigureRow>& more) {
  if (!std::ranges::equal(rows, more, is_same)) {
    throw InputError("a program measured other meshes in one turn than in the turn before");
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].median_ns = std::min(rows[i].median_ns, more[i].median_ns);
    rows[i].p99_ns = std::min(rows[i].p99_ns, more[i].p99_ns);
    rows[i].p999_ns = std::min(rows[i].p999_ns, more[i].p999_ns);
  }
}

std::vector<ComparedRow> paired(const std::vector<FigureRow>& here,
                                const std::vector<FigureRow>& there) {
  std::vector<ComparedRow> rows;
  for (const FigureRow& row : here) {
    const auto other = std::ranges::find_if(
        there, [&](const FigureRow& candidate) { return is_same(row, candidate); });
    if (other != there.end()) {
      rows.push_back({.here = row, .there = *other});
    }
  }
  return rows;
}

std::filesystem::path program_in(const std::filesystem::path& folder) {
  for (const auto& program : {folder / "tactus", folder / "bin" / "tactus"}) {
    if (std::filesystem::is_regular_file(program)) {
      return std::filesystem::absolute(program);
    }
  }
  throw InputError(fmt::format(
      "{}: no program tactus in it or in its bin/; build the other commit with `cmake --workflow "
      "--preset release` or `cmake --build`, and name its folder build/release",
      folder.string()));
}

std::vector<ComparedRow> compare(const Comparison& comparison) {
  const std::array programs{std::filesystem::read_symlink("/proc/self/exe"),
                            program_in(comparison.folder)};
  const PrivateFolder work;
  std::array<std::vector<FigureRow>, 2> rows;
  for (std::size_t turn = 1; turn <= comparison.turns; ++turn) {
    const bool counts = comparison.instructions && turn == 1;
    const std::string words = comparison.words + (counts ? " --instructions" : "");
    for (std::size_t i = 0; i < programs.size(); ++i) {
      if (comparison.progress) {
        comparison.progress(turn, i == 0);
      }
      const auto more = run(programs[i], words, work.path() / fmt::format("{}_{}.csv", turn, i));
      if (turn == 1) {
        rows[i] = more;
      } else {
        keep_least(rows[i], more);
      }
    }
  }
  return paired(rows[0], rows[1]);
}

}  // namespace tactus::host
