// A record of friction as a measurement would give it: a model on a motion, and noise.
#pragma once

#include <cmath>
#include <functional>
#include <random>

#include "host_tools/friction/fit_record.h"
#include "rendering/friction/friction_model.h"

namespace tactus::testing {

struct RecordPlan {
  rendering::FrictionParameters friction;
  std::function<double(double t_s)> x_m;
  double rate_hz = 1000.0;
  double seconds = 10.0;
  double noise = 0.05;  // of the root mean square of the force
  double normal_force_N = 1.0;
  // Each tick of the record is that many of the model, so that it is not the fitted one to the bit.
  int ticks_a_row = 8;
  std::uint64_t seed = 1;
};

inline host::FrictionRecord noisy_record(const RecordPlan& plan) {
  host::FrictionRecord record;
  record.has_normal_force = plan.normal_force_N != 1.0;
  rendering::FrictionMemory<double> memory;
  const auto rows = static_cast<std::size_t>(std::lround(plan.seconds * plan.rate_hz));
  const double step_s = 1.0 / plan.rate_hz / plan.ticks_a_row;
  double force_N = 0.0;
  double sum = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double t_s = static_cast<double>(row) / plan.rate_hz;
    for (int tick = plan.ticks_a_row; tick > 0 && row > 0; --tick) {
      const double end_s = t_s - (tick - 1) * step_s;
      force_N = rendering::update_friction(plan.friction, memory,
                                           plan.x_m(end_s) - plan.x_m(end_s - step_s),
                                           plan.normal_force_N, step_s)
                    .force_N;
    }
    record.t_s.push_back(t_s);
    record.x_m.push_back(plan.x_m(t_s));
    record.force_N.push_back(force_N);
    record.normal_force_N.push_back(plan.normal_force_N);
    record.step_s.push_back(row == 0 ? 0.0 : t_s - record.t_s[row - 1]);
    record.displacement_m.push_back(row == 0 ? 0.0 : record.x_m[row] - record.x_m[row - 1]);
    sum += force_N * force_N;
  }
  std::mt19937_64 random(plan.seed);
  std::normal_distribution<double> noise(0.0,
                                         plan.noise * std::sqrt(sum / static_cast<double>(rows)));
  for (double& force : record.force_N) {
    force += noise(random);
  }
  return record;
}

}  // namespace tactus::testing
