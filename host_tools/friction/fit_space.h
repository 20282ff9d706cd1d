// The numbers that a fit of a friction model searches for, and the model that they stand for.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "host_tools/friction/fit_record.h"
#include "rendering/friction/friction_model.h"

namespace tactus::host {

// The quantities of the search. All but the last enter by their logarithm.
enum class Quantity : std::size_t {
  coulomb,
  excess,  // Fs - Fc
  viscous,
  stribeck_velocity,
  exponent,
  stiffness,
  damping,
  start_force,  // elastic, N, in the first row: the record may begin in the middle of a slip
};
inline constexpr std::size_t kQuantities = 8;

// Returns the symbol of parameter_names.h, which is Fs for the excess and empty for the start
// force.
std::string_view symbol_of(Quantity quantity);

// The time to which the velocity-dependent part of a row's force belongs. The velocity itself is
// known as its mean over a tick.
enum class RowTime {
  instant,  // that of the moment, as sensors give it: the mean of the ticks before and after
  tick,     // that of the tick before, as `tactus friction` and a controller give it
};

// A point of the search. `free` are searched, the others stay.
struct FitPoint {
  rendering::FrictionKind kind{};
  std::array<double, kQuantities> values{};
  std::array<bool, kQuantities> free{};
  double force_scale_N = 1.0;  // of the start force
  RowTime row_time = RowTime::instant;

  [[nodiscard]] double operator[](Quantity q) const { return values[index(q)]; }
  void set(Quantity q, double value) { values[index(q)] = value; }
  void set_free(Quantity q, bool is_free) { free[index(q)] = is_free; }
  [[nodiscard]] bool is_free(Quantity q) const { return free[index(q)]; }
  [[nodiscard]] std::vector<Quantity> free_quantities() const;

  // The point that lies `by` away: each value times exp(by), the start force plus its scale's part.
  [[nodiscard]] FitPoint moved(const Eigen::VectorXd& by) const;
  [[nodiscard]] rendering::FrictionParameters friction() const;

  static std::size_t index(Quantity q) { return static_cast<std::size_t>(q); }
};

// The model's forces over the record, a value a row. Without bristles a model has no value at rest,
// only a bound: where the motion turns back it is the measured force within that. In the first row
// it is the measured one unless the start force is searched.
void model_forces(const FitPoint& point, const FrictionRecord& record, Eigen::VectorXd& out);

// Returns the sum over all rows of the squared difference between model and measurement, N^2.
double sum_of_squares(const FitPoint& point, const FrictionRecord& record);

}  // namespace tactus::host
