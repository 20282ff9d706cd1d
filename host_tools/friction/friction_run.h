// Runs a friction model on a given motion, or on a mass that is pushed, and writes the result.
// `tactus friction` and the experiments use it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/friction/friction_model.h"

namespace tactus::host {

// The rates of steps that the tools take, Hz.
inline constexpr double kLeastFrictionRate_hz = 1.0;
inline constexpr double kMostFrictionRate_hz = 1e6;

// One row of the output.
struct FrictionSample {
  // The row's time, place and velocity. The velocity is the mean over a tick, except that of a
  // mass, which is the mass's own at that time.
  double t_s = 0.0;
  double x_m = 0.0;
  double v_m_per_s = 0.0;
  // The friction force along the motion, as in the papers: a mass feels -force_N.
  double force_N = 0.0;
  // The deflection of the bristle.
  double bristle_m = 0.0;
};

// A further column of the output.
struct NamedColumn {
  std::string name;
  // One for each sample.
  std::vector<double> values;
};

// The course of a run.
struct FrictionTrack {
  std::vector<FrictionSample> samples;
  // The columns of the run beside the usual ones.
  std::vector<NamedColumn> more;

  // Returns the column of that name, or nullptr if there is none.
  [[nodiscard]] const NamedColumn* column(std::string_view name) const;
};

// A quantity over time, from a file.
struct TimeSeries {
  std::vector<double> t_s;
  std::vector<double> value;

  // Returns the value at a time, by linear interpolation between the rows; beyond the ends it is
  // the end's value.
  [[nodiscard]] double at(double time_s) const;
};

// Reads the columns t_s and `column`. Throws InputError that names file, line and column, for what
// CsvTable finds, time that does not rise, and fewer than two rows.
TimeSeries read_time_series(const std::filesystem::path& file, std::string_view column);

// Returns the series at `rate_hz`, by linear interpolation between the rows.
TimeSeries resampled(const TimeSeries& series, double rate_hz);

// A model and what presses on it; `friction` must be valid.
struct MotionRun {
  rendering::FrictionParameters friction;
  double normal_force_N = 1.0;
};

// Returns one sample a row of `x_m`. The first one is at rest and without force; the velocity of
// the others is the difference to the row before.
FrictionTrack run_motion(const MotionRun& run, const TimeSeries& x_m);

// A model, a mass and the rate of the steps; `friction` must be valid.
struct PushRun {
  rendering::FrictionParameters friction;
  double normal_force_N = 1.0;
  double mass_kg = 1.0;
  double rate_hz = 1000.0;
};

// Pushes a mass that is at rest at x = 0. Returns one sample a tick, with the further column
// push_N.
FrictionTrack run_push(const PushRun& run, const TimeSeries& push_N);

// Writes the columns t_s,x_m,v_m_per_s,force_N,bristle_m and the further ones, whole or not at all.
// Throws InputError that names the file.
void write_track(const std::filesystem::path& file, const FrictionTrack& track);

}  // namespace tactus::host
