// Computes the resolution and the force of a device at any place of its handle, out of its
// geometry, encoders, motors and weights.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "firmware/device_file/device_config.h"
#include "host_tools/simulation/device_presets.h"

namespace tactus::host {

// A place of the handle.
struct ReachPoint {
  // The longest step of the handle, m, for one count of one encoder.
  double resolution_m = 0.0;
  // The force, N, that the motors give in every direction in which the handle can move, while they
  // hold up the weights. 0 where the weights take all of a motor.
  double force_N = 0.0;
  // The share of each motor's torque that holds up the weights.
  std::array<double, kPlantJoints> weight_share{};
};

// A box in the base frame B, m; empty until a point is included.
struct ReachBox {
  Vec3 lower_B = Vec3::Constant(1e9);
  Vec3 upper_B = Vec3::Constant(-1e9);

  [[nodiscard]] bool is_empty() const { return lower_B.x() > upper_B.x(); }
  void include(const Vec3& p_B) {
    lower_B = lower_B.cwiseMin(p_B);
    upper_B = upper_B.cwiseMax(p_B);
  }
};

// Returns the torque, N m, to which the drive of an axis clamps its commands; nothing for a board
// whose file says nothing about it.
std::optional<double> drive_torque_Nm(const firmware::AxisConfig& axis);

// The map of one device.
class ReachMap {
 public:
  // The configuration must outlive the map. Throws InputError as described_device() does.
  explicit ReachMap(const firmware::DeviceConfig& config);

  // Returns what the device does at a place of B; nothing if the handle does not reach it within
  // the joints' limits. With one or two joints the place is moved onto the arc or plane first.
  [[nodiscard]] std::optional<ReachPoint> at(const Vec3& p_B) const;

  // Returns the smallest box around everything that the handle reaches, on a grid.
  [[nodiscard]] ReachBox whole_box() const;

  // Returns the simulated device, whose stops are the usual workspace.
  [[nodiscard]] const DevicePreset& device() const { return device_; }
  [[nodiscard]] const firmware::DeviceConfig& config() const { return *config_; }
  // Returns the torque or force that joint `i` gives: the smaller one of its limit and its drive's.
  [[nodiscard]] double effort(std::size_t i) const { return effort_[i]; }
  // Returns the size of a count of joint `i`'s encoder, rad or m.
  [[nodiscard]] double resolution(std::size_t i) const { return resolution_[i]; }

 private:
  const firmware::DeviceConfig* config_;
  DevicePreset device_;
  firmware::Mechanism mechanism_;
  std::array<double, kPlantJoints> effort_{};
  std::array<double, kPlantJoints> resolution_{};
};

}  // namespace tactus::host
