// Running a friction model on a motion, or on a mass that is pushed, and writing what came of it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/friction/friction_model.h"

namespace tactus::host {

struct FrictionSample {
  double t_s = 0.0;
  double x_m = 0.0;
  double v_m_per_s = 0.0;
  double force_N = 0.0;  // along the motion, as the papers have it
  double bristle_m = 0.0;
};

// A further column of the output.
struct NamedColumn {
  std::string name;
  std::vector<double> values;  // one a sample
};

struct FrictionTrack {
  std::vector<FrictionSample> samples;
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

// The columns t_s and `column`. Throws InputError naming file, line and column: what CsvTable
// finds, time that does not grow, fewer than two rows.
TimeSeries read_time_series(const std::filesystem::path& file, std::string_view column);

// Returns the series at `rate_hz`, by linear interpolation between the rows.
TimeSeries resampled(const TimeSeries& series, double rate_hz);

struct MotionRun {
  rendering::FrictionParameters friction;  // valid
  double normal_force_N = 1.0;
};

// One sample a row of x_m: the first is at rest and without force, the velocity of the others is
// the difference to the row before.
FrictionTrack run_motion(const MotionRun& run, const TimeSeries& x_m);

struct PushRun {
  rendering::FrictionParameters friction;  // valid
  double normal_force_N = 1.0;
  double mass_kg = 1.0;
  double rate_hz = 1000.0;
};

// A mass at rest at x = 0 is pushed; one sample a tick, with the column push_N.
FrictionTrack run_push(const PushRun& run, const TimeSeries& push_N);

// Header t_s,x_m,v_m_per_s,force_N,bristle_m and the further columns. Whole or not at all; throws
// InputError naming the file.
void write_track(const std::filesystem::path& file, const FrictionTrack& track);

}  // namespace tactus::host
