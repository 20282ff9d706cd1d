// A device as a user describes it in ten answers, and the mechanisms and drives that there are.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// A length of a mechanism, and the usual one, m.
struct PlannedLength {
  // The key in [mechanism]; empty for the travel of a Cartesian device.
  std::string_view key;
  std::string_view words;
  double usual_m = 0.0;
};

// A mechanism that `tactus init arm` offers.
struct PlannedMechanism {
  std::string_view name;
  // `kind` of [mechanism].
  std::string_view kind;
  std::string_view words;
  std::span<const std::string_view> joints;
  std::span<const PlannedLength> lengths;
  // The usual ratio and torque of a motor, N m, and the usual mass of the handle.
  double ratio = 1.0;
  double torque_Nm = 0.0;
  double handle_kg = 0.0;
};

// A kind of drives that `tactus init arm` offers.
struct PlannedDrive {
  // `driver` of [[axis]].
  std::string_view name;
  std::string_view words;
  // The question about its connection, and the usual answer.
  std::string_view connection_words;
  std::string_view connection;
  // The only mechanism that the drive's board turns; empty: any.
  std::string_view mechanism;
  // The name of its verb of `tactus emulate`; empty: it emulates none with so many joints.
  std::string_view emulated;
};

// Return all of them.
std::span<const PlannedMechanism> planned_mechanisms();
std::span<const PlannedDrive> planned_drives();

// The device.
struct DevicePlan {
  const PlannedMechanism* mechanism = nullptr;
  const PlannedDrive* drive = nullptr;
  // One for each of the mechanism's lengths.
  std::vector<double> lengths_m;
  // One for each joint: turns of the motor for a turn of the joint, or rad for each m.
  std::vector<double> ratios;
  // Counts of the encoder for a turn of the motor.
  double counts_per_turn = 0.0;
  double torque_Nm = 0.0;
  double torque_constant_Nm_per_A = 0.0;
  // The CAN interface, serial port or GPIO chip.
  std::string connection;
  double rate_hz = 0.0;
  double handle_kg = 0.0;

  [[nodiscard]] std::size_t joints() const { return mechanism->joints.size(); }
  // Returns the mechanism in words, such as "serial arm".
  [[nodiscard]] std::string title() const;
  // Returns true if its drives are of that driver.
  [[nodiscard]] bool is_on(std::string_view driver) const { return drive->name == driver; }
  // Returns true if the joints slide.
  [[nodiscard]] bool slides() const { return mechanism->kind == "cartesian"; }
};

// Returns the rate at which a bus carries so many drives of that kind.
double usual_rate_hz(const PlannedDrive& drive, std::size_t joints);

}  // namespace tactus::host
