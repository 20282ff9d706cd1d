#include "host_tools/plot/bodies_data.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 8> kBodyColumns = {"t_s", "x_m", "y_m", "z_m",
                                                          "qw",  "qx",  "qy",  "qz"};

}  // namespace

std::vector<BodiesFrame> read_bodies(const std::filesystem::path& file, std::size_t bodies) {
  const CsvTable table = CsvTable::read(file, kBodyColumns);
  if (bodies == 0 || table.rows() % bodies != 0) {
    throw InputError(
        fmt::format("{}: {} rows are not those of the scene's {} bodies; give the "
                    "scene of this run",
                    file.string(), table.rows(), bodies));
  }
  const auto value = [&](std::string_view column, std::size_t row) {
    return table.column(column)[row];
  };
  std::vector<BodiesFrame> frames;
  frames.reserve(table.rows() / bodies);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t_s = value("t_s", row);
    if (row % bodies == 0) {
      frames.push_back({.t_s = t_s, .bodies = {}});
    } else if (t_s != frames.back().t_s) {
      throw InputError(
          fmt::format("{}:{}: column t_s: {} begins before all {} bodies have had "
                      "their row at {}; give the scene of this run",
                      file.string(), table.line(row), t_s, bodies, frames.back().t_s));
    }
    const Eigen::Quaterniond q(value("qw", row), value("qx", row), value("qy", row),
                               value("qz", row));
    frames.back().bodies.push_back(
        {.center_W = {value("x_m", row), value("y_m", row), value("z_m", row)},
         .axes_W = q.normalized().toRotationMatrix()});
  }
  return frames;
}

}  // namespace tactus::host
