#include "host_tools/touch/tool_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"

namespace tactus::host {

ToolPath::ToolPath(const std::string& file) : file_(file) {
  constexpr std::array<std::string_view, 4> kColumns{"t_s", "x_m", "y_m", "z_m"};
  const CsvTable table = CsvTable::read(file, kColumns);
  const auto t = table.column("t_s");
  const auto x = table.column("x_m");
  const auto y = table.column("y_m");
  const auto z = table.column("z_m");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (row > 0 && t[row] <= t[row - 1]) {
      throw InputError(fmt::format(
          "{}:{}: column t_s: {} does not come after {}; time must grow from row to row", file,
          table.line(row), t[row], t[row - 1]));
    }
    lines_.push_back(table.line(row));
    times_s_.push_back(t[row]);
    positions_W_.emplace_back(x[row], y[row], z[row]);
  }
}

ToolPath ToolPath::sampled(double rate_Hz) const {
  // A last tick that rounding puts behind the end still belongs to the path.
  constexpr double kRounding = 1e-6;
  constexpr double kMostTicks = 1e7;
  ToolPath path;
  path.file_ = file_;
  const double duration_s = times_s_.back() - times_s_.front();
  if (duration_s * rate_Hz > kMostTicks) {
    throw InputError(
        fmt::format("{}: {} s at {} Hz are more than {:.0f} ticks; choose a lower rate", file_,
                    duration_s, rate_Hz, kMostTicks));
  }
  const auto steps = static_cast<std::size_t>(std::floor(duration_s * rate_Hz + kRounding));
  std::size_t next = 1;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double t_s = times_s_.front() + static_cast<double>(k) / rate_Hz;
    while (next + 1 < size() && times_s_[next] < t_s) {
      ++next;
    }
    const double share =
        size() > 1 ? std::clamp((t_s - times_s_[next - 1]) / (times_s_[next] - times_s_[next - 1]),
                                0.0, 1.0)
                   : 0.0;
    const Vec3& from = positions_W_[next - 1];
    const Vec3& to = positions_W_[std::min(next, size() - 1)];
    path.times_s_.push_back(t_s);
    path.positions_W_.emplace_back(from + share * (to - from));
  }
  return path;
}

std::optional<std::string> ToolPath::warning() const {
  constexpr double kReach_m = 5.0;
  for (std::size_t row = 0; row < lines_.size(); ++row) {
    const double distance_m = positions_W_[row].norm();
    if (distance_m > kReach_m) {
      return fmt::format(
          "{}:{}: the tool is {:.4g} m from the world's origin; if the file has millimetres, "
          "divide its positions by 1000",
          file_, lines_[row], distance_m);
    }
  }
  return std::nullopt;
}

double ToolPath::step_s(std::size_t tick) const {
  constexpr double kDefaultTick_s = 1e-3;
  if (size() < 2) {
    return kDefaultTick_s;
  }
  const std::size_t last = std::max<std::size_t>(tick, 1);
  return times_s_[last] - times_s_[last - 1];
}

rendering::ToolState ToolPath::tool(std::size_t tick) const {
  if (tick >= size()) {
    return {.p_W = positions_W_.back()};
  }
  const Vec3& p_W = positions_W_[tick];
  const Vec3 v_W =
      tick == 0 ? Vec3{Vec3::Zero()} : Vec3{(p_W - positions_W_[tick - 1]) / step_s(tick)};
  return {.p_W = p_W, .v_W = v_W};
}

std::string ToolPath::place(std::size_t tick) const {
  return lines_.empty() ? file_ : fmt::format("{}:{}", file_, lines_[tick]);
}

}  // namespace tactus::host
