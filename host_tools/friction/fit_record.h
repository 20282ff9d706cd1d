// A measured record of friction: what a file holds, and what can be seen in it without a model.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host {

// Row k >= 1 ends the tick that began at row k - 1.
struct FrictionRecord {
  std::vector<double> t_s;
  std::vector<double> x_m;
  std::vector<double> force_N;  // along the motion
  std::vector<double> normal_force_N;
  std::vector<double> step_s;          // of the tick; 0 in row 0
  std::vector<double> displacement_m;  // of the tick; 0 in row 0
  bool has_normal_force = false;       // else it is 1 N throughout
  bool uses_velocity = false;          // the displacements come from v_m_per_s

  [[nodiscard]] std::size_t rows() const { return t_s.size(); }
  [[nodiscard]] double speed_m_per_s(std::size_t row) const;
  // The motion turns back in the tick before the row, or in the one behind it.
  [[nodiscard]] bool is_at_reversal(std::size_t row) const;
  // The force over the normal force, positive where it opposes the motion; 0 without contact.
  [[nodiscard]] double level(std::size_t row) const;
};

// Reads t_s, x_m, force_N, and where they are there v_m_per_s and normal_force_N, which
// `normal_force_N` replaces. The displacements come from x_m or, if the velocity from row to row
// is rougher in it, from v_m_per_s. Throws InputError naming file, line and column: what CsvTable
// finds, time that does not grow, fewer than 20 rows, no motion, no force, x_m and v_m_per_s in
// units that do not fit each other, a force that drives the motion instead of resisting it.
FrictionRecord read_friction_record(const std::filesystem::path& file,
                                    std::optional<double> normal_force_N);

struct RecordTraits {
  double typical_level = 0.0;    // the force over the normal force that nine in ten rows stay below
  double slowest_m_per_s = 0.0;  // one row in twenty of those that move is slower
  double fastest_m_per_s = 0.0;
  double small_step_m = 0.0;  // one in twenty of the ticks that move goes less far
  double travel_m = 0.0;      // sum of all displacements, without sign
  std::size_t reversals = 0;
  // Rows in which the force is on its way from one side to the other, after a reversal or at the
  // start: what is there to see of presliding.
  std::size_t presliding_rows = 0;
  bool is_rough = false;  // the velocity changes by half of itself from row to row
};

RecordTraits traits_of(const FrictionRecord& record);

}  // namespace tactus::host
