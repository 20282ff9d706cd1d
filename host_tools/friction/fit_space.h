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

// The quantities of the search. All but the last are searched by their logarithm.
enum class Quantity : std::size_t {
  coulomb,
  // Fs - Fc.
  excess,
  viscous,
  stribeck_velocity,
  exponent,
  stiffness,
  damping,
  // The bristle's force in the first row, N: the record may begin in the middle of a slip.
  start_force,
};
// The number of quantities in the enumeration.
inline constexpr std::size_t kQuantities = 8;

// Returns the symbol of parameter_names.h: Fs for the excess, empty for the start force.
std::string_view symbol_of(Quantity quantity);

// The time to which the velocity-dependent part of a row's force belongs. The velocity is known
// only as its mean over a tick.
enum class RowTime {
  // The moment of the row, as a sensor gives it: the mean of the ticks before and after.
  instant,
  // The tick before the row, as `tactus friction` and a controller give it.
  tick,
};

// A point of the search space. Quantities that are `free` are searched, the others keep their
// values.
struct FitPoint {
  rendering::FrictionKind kind{};
  std::array<double, kQuantities> values{};
  std::array<bool, kQuantities> free{};
  // The size of the start force, which is not searched by its logarithm.
  double force_scale_N = 1.0;
  RowTime row_time = RowTime::instant;

  [[nodiscard]] double operator[](Quantity q) const { return values[index(q)]; }
  void set(Quantity q, double value) { values[index(q)] = value; }
  void set_free(Quantity q, bool is_free) { free[index(q)] = is_free; }
  [[nodiscard]] bool is_free(Quantity q) const { return free[index(q)]; }
  // Returns the searched quantities, in the order of the vectors that moved() takes.
  [[nodiscard]] std::vector<Quantity> free_quantities() const;

  // Returns the point that lies `by` away: each free value times exp(by), and the start force plus
  // `by` times its scale.
  [[nodiscard]] FitPoint moved(const Eigen::VectorXd& by) const;
  // Returns the model at this point.
  [[nodiscard]] rendering::FrictionParameters friction() const;

  static std::size_t index(Quantity q) { return static_cast<std::size_t>(q); }
};

// Writes the model's force of each row, N. A model without bristles has no force at rest, only a
// bound: where the motion turns back it takes the measured force within that bound. In the first
// row it takes the measured force, unless the start force is searched.
void model_forces(const FitPoint& point, const FrictionRecord& record, Eigen::VectorXd& out);

// Returns the sum over all rows of the squared difference between model and measurement, N^2.
double sum_of_squares(const FitPoint& point, const FrictionRecord& record);

}  // namespace tactus::host
