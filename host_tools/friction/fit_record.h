// A measured record of friction: the columns of a file, and the traits that can be seen in it
// without a model. fit.h works on it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host {

// The record. Row k >= 1 ends the tick that began at row k - 1.
struct FrictionRecord {
  std::vector<double> t_s;
  std::vector<double> x_m;
  // The friction force along the motion, positive in the direction of positive x.
  std::vector<double> force_N;
  // The force that presses the bodies together.
  std::vector<double> normal_force_N;
  // The duration of the tick that ends at the row; 0 in row 0.
  std::vector<double> step_s;
  // The displacement in that tick; 0 in row 0.
  std::vector<double> displacement_m;
  // False if no normal force was given; it is then 1 N throughout.
  bool has_normal_force = false;
  // True if the displacements come from the column v_m_per_s.
  bool uses_velocity = false;

  [[nodiscard]] std::size_t rows() const { return t_s.size(); }
  // Returns the mean speed in the row's tick, without sign; the row must not be 0.
  [[nodiscard]] double speed_m_per_s(std::size_t row) const;
  // Returns true if the motion turns back between the row's tick and the one before or after it.
  [[nodiscard]] bool is_at_reversal(std::size_t row) const;
  // Returns the force over the normal force, positive where it opposes the motion; 0 without
  // contact.
  [[nodiscard]] double level(std::size_t row) const;
};

// Reads t_s, x_m and force_N, and v_m_per_s and normal_force_N if the file has them.
// `normal_force_N` replaces the column. The displacements come from x_m, or from v_m_per_s if the
// velocity is rougher in x_m. Throws InputError that names file, line and column, for what CsvTable
// finds and for: time that does not rise, fewer than 20 rows, no motion, no force, x_m and
// v_m_per_s in units that do not fit each other, and a force that drives the motion instead of
// resisting it.
FrictionRecord read_friction_record(const std::filesystem::path& file,
                                    std::optional<double> normal_force_N);

// The traits of a record that show without a model.
struct RecordTraits {
  // The force over the normal force below which nine rows in ten are.
  double typical_level = 0.0;
  // One in twenty of the moving rows is slower than this.
  double slowest_m_per_s = 0.0;
  double fastest_m_per_s = 0.0;
  // One in twenty of the moving ticks is shorter than this.
  double small_step_m = 0.0;
  // The sum of all displacements, without sign.
  double travel_m = 0.0;
  // How often the motion turns back.
  std::size_t reversals = 0;
  // Rows in which the force is on its way from one side to the other, at the start or after a
  // reversal: what the record shows of presliding.
  std::size_t presliding_rows = 0;
  // True if the velocity changes by half of itself from row to row.
  bool is_rough = false;
};

// Returns the traits of a record.
RecordTraits traits_of(const FrictionRecord& record);

}  // namespace tactus::host
