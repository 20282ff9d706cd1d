// Reads the runs that are drawn: recordings, and the tables of `tactus` and of recorders.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/control/mode.h"
#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/run_data.h"
#include "host_tools/recording/recording.h"

namespace tactus::host {
namespace {

using ColumnTriple = std::array<std::string_view, 3>;

// The names of the columns in one kind of table.
struct RunColumns {
  std::string_view time;
  ColumnTriple proxy;
  // The rendered force.
  ColumnTriple force;
  // The force after the safety limits. Tables of `tactus touch` have none.
  ColumnTriple commanded;
  std::string_view friction;
};

// A table of `tactus sim` or `tactus touch`.
constexpr RunColumns kOfSimulation = {
    .time = "t_s",
    .proxy = {"proxy_x_m", "proxy_y_m", "proxy_z_m"},
    .force = {"force_x_N", "force_y_N", "force_z_N"},
    .commanded = {"commanded_force_x_N", "commanded_force_y_N", "commanded_force_z_N"},
    .friction = "friction_state"};
// A table of a recorder or of `tactus export`.
constexpr RunColumns kOfRecorder = {.time = "time_s",
                                    .proxy = {"proxy_x_m", "proxy_y_m", "proxy_z_m"},
                                    .force = {"rendered_x_N", "rendered_y_N", "rendered_z_N"},
                                    .commanded = {"force_x_N", "force_y_N", "force_z_N"},
                                    .friction = "friction"};
constexpr std::string_view kMode = "mode";
constexpr std::string_view kContact = "contact";
constexpr std::string_view kDepth = "depth_m";

// Returns true if the controller knows where the tool is: homing is over.
bool is_located(double mode) {
  return mode >= static_cast<double>(firmware::Mode::ready);
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

// A table whose rows are taken one after the other.
class RunTable {
 public:
  RunTable(const std::filesystem::path& file, const RunColumns& columns)
      : file_(file), columns_(columns), table_(read(file, columns)) {}

  [[nodiscard]] std::size_t rows() const { return table_.rows(); }
  [[nodiscard]] bool has_commanded() const {
    return std::ranges::all_of(columns_.commanded,
                               [&](std::string_view name) { return table_.has(name); });
  }

  // Returns a row. Throws InputError.
  [[nodiscard]] RunRow row(std::size_t i) const {
    RunRow row{.t_s = table_.column(columns_.time)[i],
               .proxy_W = triple(i, columns_.proxy),
               .force_W = triple(i, columns_.force),
               .depth_m = table_.column(kDepth)[i],
               .contact = table_.column(kContact)[i] != 0.0,
               .located = !table_.has(kMode) || is_located(table_.column(kMode)[i])};
    row.force_N = row.force_W.norm();
    row.commanded_N = has_commanded() ? triple(i, columns_.commanded).norm() : row.force_N;
    const double friction = table_.column(columns_.friction)[i];
    const std::optional<rendering::FrictionState> state = friction_state(friction);
    if (!state) {
      fail(i, fmt::format("column {}: {} is none of 0 (free), 1 (stick), 2 (slip)",
                          columns_.friction, friction));
    }
    row.friction = *state;
    return row;
  }

  [[noreturn]] void fail(std::size_t i, const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_.string(), table_.line(i), what));
  }

 private:
  static CsvTable read(const std::filesystem::path& file, const RunColumns& columns) {
    std::vector<std::string_view> required{columns.time, columns.friction, kContact, kDepth};
    required.insert(required.end(), columns.proxy.begin(), columns.proxy.end());
    required.insert(required.end(), columns.force.begin(), columns.force.end());
    std::vector<std::string_view> optional(columns.commanded.begin(), columns.commanded.end());
    optional.push_back(kMode);
    const std::array<CsvWords, 1> words{{{.column = kMode, .words = firmware::kModeNames}}};
    return CsvTable::read(file, required, optional, words);
  }

  [[nodiscard]] Vec3 triple(std::size_t row, const ColumnTriple& names) const {
    return {table_.column(names[0])[row], table_.column(names[1])[row],
            table_.column(names[2])[row]};
  }

  std::filesystem::path file_;
  RunColumns columns_;
  CsvTable table_;
};

RunData read_table(const std::filesystem::path& file) {
  const bool is_recorded = csv_heading(file).find(kOfRecorder.time) != std::string::npos;
  const RunColumns& columns = is_recorded ? kOfRecorder : kOfSimulation;
  const RunTable table(file, columns);
  RunData run{.has_commanded = table.has_commanded()};
  run.rows.reserve(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const RunRow row = table.row(i);
    if (i > 0 && row.t_s <= run.rows.back().t_s) {
      table.fail(i, fmt::format("column {}: {} does not come after {}", columns.time, row.t_s,
                                run.rows.back().t_s));
    }
    run.rows.push_back(row);
  }
  return run;
}

Vec3 vector_of(const firmware::Triple& triple) {
  return {triple[0], triple[1], triple[2]};
}

RunRow row_of(const firmware::TelemetryRecord& record) {
  const Vec3 force_W = vector_of(record.force_rendered_W);
  return {.t_s = record.time_s,
          .proxy_W = vector_of(record.proxy_W),
          .force_W = force_W,
          .force_N = force_W.norm(),
          .commanded_N = vector_of(record.force_commanded_W).norm(),
          .depth_m = record.depth_m,
          .contact = record.contact != rendering::ContactKind::none,
          .located = is_located(static_cast<double>(record.mode)),
          .friction = record.friction};
}

RunData read_recording(const std::filesystem::path& file) {
  Recording recording(file.string());
  RunData run{.has_commanded = true};
  while (const auto tick = recording.next()) {
    const RunRow row = row_of(tick->record);
    if (!run.rows.empty() && row.t_s <= run.rows.back().t_s) {
      throw InputError(fmt::format("{}: tick {} at {} s does not come after {} s", file.string(),
                                   tick->record.tick, row.t_s, run.rows.back().t_s));
    }
    run.rows.push_back(row);
  }
  if (run.rows.empty()) {
    throw InputError(fmt::format("{}: the recording holds no tick", file.string()));
  }
  run.is_cut = recording.cut();
  return run;
}

}  // namespace

bool is_recording(const std::filesystem::path& file) {
  return file.extension() == ".mcap";
}

RunData read_run(const std::filesystem::path& file) {
  return is_recording(file) ? read_recording(file) : read_table(file);
}

}  // namespace tactus::host
