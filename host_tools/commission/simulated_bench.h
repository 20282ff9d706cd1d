// Commissioning with a simulated device and a simulated person who does what is asked, for
// rehearsals (`tactus commission --simulated`) and tests. It can have mistakes in its wiring.
#pragma once

#include <array>

#include "host_tools/commission/bench.h"
#include "host_tools/simulation/simulated_device.h"

namespace tactus::host {

// How the device's wiring or scales differ from device.toml, joint by joint.
struct WiringMistake {
  // The effort that a motor makes for each unit of command; -1: it is reversed.
  std::array<double, kPlantJoints> torque_scale{1.0, 1.0, 1.0};
  // The position that an encoder reports for each unit of the true one; -1: it is reversed.
  std::array<double, kPlantJoints> position_scale{1.0, 1.0, 1.0};
  // The joint that each motor moves.
  std::array<std::size_t, kPlantJoints> motor_of{0, 1, 2};
  // True if the drives report their torque, in the units that they believe in.
  bool reports_torque = false;
  // True if the person does not let go when asked to.
  bool holds_the_handle = false;
};

// A simulated device on the bench. wait() advances the simulation by one tick and does not sleep.
class SimulatedBench final : public Bench {
 public:
  // Places the device at rest at `middle_B`, m, in its base frame.
  SimulatedBench(const DeviceParameters& parameters, double rate_hz, const Vec3& middle_B,
                 const WiringMistake& mistake = {});

  void read(drivers::JointSample& sample) override;
  void write(const drivers::JointCommand& command) override;
  void wait() override;
  void ask(HandTask task) override;
  bool is_at_work(HandTask task) override;
  [[nodiscard]] std::string trouble() const override { return {}; }

  // Returns the largest distance of the handle from where it was let go.
  [[nodiscard]] double moved_m() const { return moved_m_; }

 private:
  [[nodiscard]] Vec3 wish_at(double time_s) const;
  [[nodiscard]] double task_s() const;

  DeviceParameters parameters_;
  double step_s_;
  Vec3 middle_B_;
  WiringMistake mistake_;
  SimulatedDevice device_;
  HandTask task_ = HandTask::let_go;
  // Ticks since the last task was asked for.
  std::uint64_t ticks_ = 0;
  double moved_m_ = 0.0;
  drivers::JointCommand written_;
};

}  // namespace tactus::host
