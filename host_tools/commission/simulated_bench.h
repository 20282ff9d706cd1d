// A simulated device on the bench, for rehearsals and tests: with a person who does what is asked,
// and, if wanted, with a mistake in its wiring.
#pragma once

#include <array>

#include "host_tools/commission/bench.h"
#include "host_tools/simulation/simulated_device.h"

namespace tactus::host {

// Differences between the device's wiring or scales and device.toml, by joint.
struct WiringMistake {
  std::array<double, kPlantJoints> torque_scale{1.0, 1.0, 1.0};    // -1: the motor is reversed
  std::array<double, kPlantJoints> position_scale{1.0, 1.0, 1.0};  // -1: the encoder is
  std::array<std::size_t, kPlantJoints> motor_of{0, 1, 2};         // which joint each motor moves
  bool reports_torque = false;    // the drive reports what it does, in the units that it believes
  bool holds_the_handle = false;  // the person does not let go
};

class SimulatedBench final : public Bench {
 public:
  // The device begins at rest at `middle_B`, m.
  SimulatedBench(const DeviceParameters& parameters, double rate_hz, const Vec3& middle_B,
                 const WiringMistake& mistake = {});

  void read(drivers::JointSample& sample) override;
  void write(const drivers::JointCommand& command) override;
  void wait() override;
  void ask(HandTask task) override;
  bool is_at_work(HandTask task) override;
  [[nodiscard]] std::string trouble() const override { return {}; }

  // The largest distance of the handle from where it was let go, m.
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
  std::uint64_t ticks_ = 0;  // since the task was asked for
  double moved_m_ = 0.0;
  drivers::JointCommand written_;
};

}  // namespace tactus::host
