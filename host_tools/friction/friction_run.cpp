#include "host_tools/friction/friction_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>

#include "host_tools/csv/csv_table.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/friction/sliding_mass.h"
#include "host_tools/input_error.h"

namespace tactus::host {

const NamedColumn* FrictionTrack::column(std::string_view name) const {
  const auto found = std::ranges::find(more, name, &NamedColumn::name);
  return found == more.end() ? nullptr : &*found;
}

double TimeSeries::at(double time_s) const {
  const auto after = std::ranges::upper_bound(t_s, time_s);
  if (after == t_s.begin()) {
    return value.front();
  }
  if (after == t_s.end()) {
    return value.back();
  }
  const auto i = static_cast<std::size_t>(after - t_s.begin());
  return std::lerp(value[i - 1], value[i], (time_s - t_s[i - 1]) / (t_s[i] - t_s[i - 1]));
}

TimeSeries read_time_series(const std::filesystem::path& file, std::string_view column) {
  const std::array<std::string_view, 2> columns{"t_s", column};
  const CsvTable table = CsvTable::read(file, columns);
  const auto t = table.column("t_s");
  for (std::size_t row = 1; row < table.rows(); ++row) {
    if (t[row] <= t[row - 1]) {
      throw InputError(fmt::format(
          "{}:{}: column t_s: {} does not come after {}; time must grow from row to row",
          file.string(), table.line(row), t[row], t[row - 1]));
    }
  }
  if (table.rows() < 2) {
    throw InputError(fmt::format("{}:{}: one row is no course in time; give two or more",
                                 file.string(), table.line(0)));
  }
  const auto values = table.column(column);
  return {.t_s = {t.begin(), t.end()}, .value = {values.begin(), values.end()}};
}

namespace {

// Returns the number of whole ticks in a course; rounding of its ends is forgiven.
std::size_t ticks_in(const TimeSeries& series, double rate_hz) {
  constexpr double kSlack = 1e-9;
  const double ticks = (series.t_s.back() - series.t_s.front()) * rate_hz;
  return static_cast<std::size_t>(std::floor(ticks * (1.0 + kSlack) + kSlack));
}

}  // namespace

TimeSeries resampled(const TimeSeries& series, double rate_hz) {
  TimeSeries result;
  for (std::size_t k = 0; k <= ticks_in(series, rate_hz); ++k) {
    result.t_s.push_back(series.t_s.front() + static_cast<double>(k) / rate_hz);
    result.value.push_back(series.at(result.t_s.back()));
  }
  return result;
}

FrictionTrack run_motion(const MotionRun& run, const TimeSeries& x_m) {
  FrictionTrack track;
  track.samples.reserve(x_m.t_s.size());
  track.samples.push_back({.t_s = x_m.t_s[0], .x_m = x_m.value[0]});
  rendering::FrictionMemory<double> memory;
  for (std::size_t k = 1; k < x_m.t_s.size(); ++k) {
    const double step_s = x_m.t_s[k] - x_m.t_s[k - 1];
    const double displacement_m = x_m.value[k] - x_m.value[k - 1];
    const auto friction = rendering::update_friction(run.friction, memory, displacement_m,
                                                     run.normal_force_N, step_s);
    track.samples.push_back({.t_s = x_m.t_s[k],
                             .x_m = x_m.value[k],
                             .v_m_per_s = displacement_m / step_s,
                             .force_N = friction.force_N,
                             .bristle_m = friction.bristle_m});
  }
  return track;
}

FrictionTrack run_push(const PushRun& run, const TimeSeries& push_N) {
  SlidingMass mass(
      {.friction = run.friction, .mass_kg = run.mass_kg, .normal_force_N = run.normal_force_N});
  const double step_s = 1.0 / run.rate_hz;
  const double start_s = push_N.t_s.front();
  FrictionTrack track;
  NamedColumn push{.name = "push_N", .values = {push_N.value.front()}};
  track.samples.push_back({.t_s = start_s});
  for (std::size_t k = 1; k <= ticks_in(push_N, run.rate_hz); ++k) {
    const double end_s = start_s + static_cast<double>(k) / run.rate_hz;
    const SlidingMassState& now = mass.step({.push_N = push_N.at(end_s - 0.5 * step_s)}, step_s);
    track.samples.push_back({.t_s = end_s,
                             .x_m = now.x_m,
                             .v_m_per_s = now.v_m_per_s,
                             .force_N = now.friction.force_N,
                             .bristle_m = now.friction.bristle_m});
    push.values.push_back(push_N.at(end_s));
  }
  track.more.push_back(std::move(push));
  return track;
}

void write_track(const std::filesystem::path& file, const FrictionTrack& track) {
  std::string text = "t_s,x_m,v_m_per_s,force_N,bristle_m";
  for (const NamedColumn& column : track.more) {
    text += "," + column.name;
  }
  for (std::size_t k = 0; k < track.samples.size(); ++k) {
    const FrictionSample& s = track.samples[k];
    fmt::format_to(std::back_inserter(text), "\n{},{},{},{},{}", s.t_s, s.x_m, s.v_m_per_s,
                   s.force_N, s.bristle_m);
    for (const NamedColumn& column : track.more) {
      fmt::format_to(std::back_inserter(text), ",{}", column.values[k]);
    }
  }
  text += '\n';
  keep_images_safe(file);
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace tactus::host
