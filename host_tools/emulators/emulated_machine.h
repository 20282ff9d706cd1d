// A whole haptic device on the far side of its bus: the plant of host_tools/simulation, with a hand
// on its handle, turned by emulated drives.
//
// Fakes: the mechanism with its friction, weight and end stops; gears and capstans between each
// joint and its drive's shaft; a hand that follows a wish.
// Does not fake: play and give in the transmission, the drives' rotor inertia (it is in the plant's
// moving mass).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "drivers/composition/transmission.h"
#include "hal/clock.h"
#include "host_tools/emulators/can_emulator.h"
#include "host_tools/emulators/shaft.h"
#include "host_tools/simulation/device_presets.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/plant.h"
#include "host_tools/simulation/wish_path.h"

namespace tactus::host {

// The longest step that joint friction and end stops bear.
inline constexpr hal::TimeNs kLongestMachineStep_ns = 100'000;

struct EmulatedMachineConfig {
  DevicePreset device = cartesian_preset();
  HandParameters hand;                                 // all zero: nobody holds the handle
  WishPath path{{{.t_s = 0.0, .p_W = Vec3::Zero()}}};  // from the machine's start on
  Vec3 origin_B = Vec3::Zero();                        // m: the wish path's origin
  std::uint64_t seed = 1;                              // of the hand's tremor
  hal::TimeNs step_ns = kLongestMachineStep_ns;
  // The time after the machine's start at which the hand leaves the handle for good, s.
  double let_go_s = std::numeric_limits<double>::infinity();
};

// One joint and what drives it. The shaft must outlive the machine.
struct EmulatedAxis {
  EmulatedShaft* shaft = nullptr;
  drivers::Transmission transmission;
  std::function<void(EmulatorFault)> set_fault;
};

// The true state of the machine at one instant, which the bus does not show. Joints are in rad, or
// m if they slide.
struct MachineTruth {
  hal::TimeNs time_ns = 0;
  std::array<double, kPlantJoints> joint_position{};
  std::array<double, kPlantJoints> joint_velocity{};
  std::array<double, kPlantJoints> shaft_torque_Nm{};
  std::array<EmulatorFault, kPlantJoints> fault{};
  Vec3 handle_p_B = Vec3::Zero();     // m
  Vec3 handle_v_B = Vec3::Zero();     // m/s
  Vec3 motor_force_B = Vec3::Zero();  // N, of the motors at the handle
  Vec3 hand_force_B = Vec3::Zero();   // N, of the hand's spring and damper, mean of the last step
};

class EmulatedMachine {
 public:
  // The machine begins at rest at `start_ns` where the hand wants the handle, or in the middle of
  // the workspace. Throws InputError on a step that is not positive or too long.
  EmulatedMachine(const EmulatedMachineConfig& config, hal::TimeNs start_ns);

  // Connects the next joint's axis, beginning with joint 0. Throws InputError when all joints have
  // one, and on a transmission that is not valid.
  void connect(EmulatedAxis axis);
  // Adds the device's own program. It is called with the time of each step, after the step has
  // turned its shafts.
  void add_device(std::function<void(hal::TimeNs)> run) { devices_.push_back(std::move(run)); }

  [[nodiscard]] std::size_t joints() const { return joints_of(plant_parameters_.mechanism); }
  [[nodiscard]] hal::TimeNs start_ns() const { return start_ns_; }

  // Returns when the next step begins; plant and shafts stand still until then.
  [[nodiscard]] hal::TimeNs next_step_ns() const { return next_step_ns_; }
  // Turns the shafts to the joints' positions, runs the devices, and advances the plant by one
  // step.
  void step();
  // Makes every step that begins at `now_ns` or earlier.
  void run(hal::TimeNs now_ns);
  // Leaves out the steps that begin before `now_ns`: the machine stood still meanwhile.
  void skip_to(hal::TimeNs now_ns);

  // Sets the fault of that joint's axis.
  void set_fault(std::size_t joint, EmulatorFault fault);

  // Returns the state after the last step.
  [[nodiscard]] const MachineTruth& truth() const { return truth_; }
  [[nodiscard]] const Plant& plant() const { return plant_; }

 private:
  void turn_shafts();
  JointEfforts take_torques();
  void move(const JointEfforts& effort);

  PlantParameters plant_parameters_;
  Vec3 origin_B_;
  hal::TimeNs step_ns_;
  hal::TimeNs start_ns_;
  hal::TimeNs next_step_ns_;
  double let_go_s_;
  Hand hand_;
  Plant plant_;
  std::vector<EmulatedAxis> axes_;
  std::vector<std::function<void(hal::TimeNs)>> devices_;
  MachineTruth truth_;
};

}  // namespace tactus::host
