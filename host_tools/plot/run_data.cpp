#include "host_tools/plot/run_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 10> kRequired = {
    "t_s",       "proxy_x_m", "proxy_y_m", "proxy_z_m", "force_x_N",
    "force_y_N", "force_z_N", "contact",   "depth_m",   "friction_state"};
constexpr std::string_view kMode = "mode";
constexpr std::array<std::string_view, 3> kCommanded = {
    "commanded_force_x_N", "commanded_force_y_N", "commanded_force_z_N"};
constexpr std::array<std::string_view, 4> kOptional = {kCommanded[0], kCommanded[1], kCommanded[2],
                                                       kMode};
// The number of the mode `ready` in firmware::Mode.
constexpr double kFirstLocatedMode = 2.0;

Vec3 triple(const CsvTable& table, std::size_t row, std::string_view x, std::string_view y,
            std::string_view z) {
  return {table.column(x)[row], table.column(y)[row], table.column(z)[row]};
}

// Returns the state of a number in the file; nothing if it is none of them.
std::optional<rendering::FrictionState> friction_state(double value) {
  using enum rendering::FrictionState;
  for (const rendering::FrictionState state : {free, stick, slip}) {
    if (value == static_cast<double>(state)) {
      return state;
    }
  }
  return std::nullopt;
}

}  // namespace

RunData read_run(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file, kRequired, kOptional);
  RunData run;
  run.has_commanded =
      std::ranges::all_of(kCommanded, [&](std::string_view name) { return table.has(name); });
  run.rows.reserve(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    RunRow row;
    row.t_s = table.column("t_s")[i];
    if (i > 0 && row.t_s <= run.rows.back().t_s) {
      throw InputError(fmt::format("{}:{}: column t_s: {} does not come after {}", file.string(),
                                   table.line(i), row.t_s, run.rows.back().t_s));
    }
    row.proxy_W = triple(table, i, "proxy_x_m", "proxy_y_m", "proxy_z_m");
    row.force_W = triple(table, i, "force_x_N", "force_y_N", "force_z_N");
    row.force_N = row.force_W.norm();
    row.commanded_N = run.has_commanded
                          ? triple(table, i, kCommanded[0], kCommanded[1], kCommanded[2]).norm()
                          : row.force_N;
    row.depth_m = table.column("depth_m")[i];
    row.contact = table.column("contact")[i] != 0.0;
    // firmware::Mode: before homing is over the tool's position means nothing.
    row.located = !table.has(kMode) || table.column(kMode)[i] >= kFirstLocatedMode;
    const double friction = table.column("friction_state")[i];
    const std::optional<rendering::FrictionState> state = friction_state(friction);
    if (!state) {
      throw InputError(
          fmt::format("{}:{}: column friction_state: {} is none of 0 (free), 1 (stick), 2 (slip)",
                      file.string(), table.line(i), friction));
    }
    row.friction = *state;
    run.rows.push_back(row);
  }
  return run;
}

std::vector<std::size_t> thin(const std::vector<RunRow>& rows, std::size_t limit) {
  std::vector<std::size_t> kept;
  const std::size_t bucket =
      std::max<std::size_t>(1, (2 * rows.size() + limit - 1) / std::max<std::size_t>(1, limit));
  const auto by_force = [](const RunRow& a, const RunRow& b) { return a.force_N < b.force_N; };
  for (std::size_t first = 0; first < rows.size(); first += bucket) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end =
        rows.begin() + static_cast<std::ptrdiff_t>(std::min(first + bucket, rows.size()));
    const auto [smallest, largest] = std::minmax_element(begin, end, by_force);
    const auto [early, late] = std::minmax({smallest - rows.begin(), largest - rows.begin()});
    for (const std::ptrdiff_t index : {std::ptrdiff_t{0}, early, late}) {
      const auto row = static_cast<std::size_t>(index);
      if (kept.empty() || row > kept.back()) {
        kept.push_back(row);
      }
    }
  }
  if (!rows.empty() && kept.back() + 1 != rows.size()) {
    kept.push_back(rows.size() - 1);
  }
  return kept;
}

std::vector<Stretch> stretches(const std::vector<RunRow>& rows, rendering::FrictionState state) {
  std::vector<Stretch> found;
  bool open = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].friction != state) {
      open = false;
      continue;
    }
    const double end_s = i + 1 < rows.size() ? rows[i + 1].t_s : rows[i].t_s;
    if (open) {
      found.back().to_s = end_s;
    } else {
      found.push_back({.from_s = rows[i].t_s, .to_s = end_s});
    }
    open = true;
  }
  return found;
}

}  // namespace tactus::host
