// A whole haptic device on the far side of its bus: the plant of host_tools/simulation with a hand
// on its handle, turned by emulated drives. `tactus emulate` runs it against the clock, tests in
// simulated time.
//
// It fakes the mechanism with its friction, weight and end stops, the gears and capstans between
// each joint and its drive's shaft, and a hand that follows a wish. It does not fake play and
// compliance in the transmission, or the rotors' inertia apart from the plant's moving mass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
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

// The longest step for which the plant's joint friction and end stops are accurate.
inline constexpr hal::TimeNs kLongestMachineStep_ns = 100'000;

// The device and the hand.
struct EmulatedMachineConfig {
  DevicePreset device = cartesian_preset();
  // All zero: nobody holds the handle.
  HandParameters hand;
  // The hand's wish from the machine's start on, in the frame of the scene.
  WishPath path{{{.t_s = 0.0, .p_W = Vec3::Zero()}}};
  // The origin of the wish path in the mechanism's base frame, m.
  Vec3 origin_B = Vec3::Zero();
  // Chooses the hand's tremor.
  std::uint64_t seed = 1;
  hal::TimeNs step_ns = kLongestMachineStep_ns;
  // When the hand lets go of the handle for good, s after the machine's start.
  double let_go_s = std::numeric_limits<double>::infinity();
};

// A joint's drive. The shaft must outlive the machine.
struct EmulatedAxis {
  EmulatedShaft* shaft = nullptr;
  drivers::Transmission transmission;
  // Sets a fault of this drive.
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
  // The handle's position, m, and velocity, m/s, in the base frame.
  Vec3 handle_p_B = Vec3::Zero();
  Vec3 handle_v_B = Vec3::Zero();
  // The motors' torques as a force at the handle, N.
  Vec3 motor_force_B = Vec3::Zero();
  // The force of the hand's spring and damper on the handle, N, mean over the last step.
  Vec3 hand_force_B = Vec3::Zero();
};

// The machine. One thread.
class EmulatedMachine {
 public:
  // Begins at `start_ns` at rest, where the hand wants the handle or, without a hand, in the middle
  // of the workspace. Throws InputError if the step is not positive or is longer than
  // kLongestMachineStep_ns.
  EmulatedMachine(const EmulatedMachineConfig& config, hal::TimeNs start_ns);

  // Connects the next joint's drive, beginning with joint 0. Throws InputError if every joint has
  // one, or the transmission is not valid.
  void connect(EmulatedAxis axis);
  // Adds the program of a device. It is called in every step with the step's time, after the shafts
  // have been turned.
  void add_device(std::function<void(hal::TimeNs)> run) { devices_.push_back(std::move(run)); }
  // Adds the program of a device that acts on messages, which arrive at a descriptor. It is called
  // likewise, but not in the steps of coast().
  void add_listener(std::function<void(hal::TimeNs)> run, int descriptor);

  // Returns the number of joints of the mechanism.
  [[nodiscard]] std::size_t joints() const { return joints_of(plant_parameters_.mechanism); }
  // Returns when the machine's first step begins.
  [[nodiscard]] hal::TimeNs start_ns() const { return start_ns_; }

  // Returns when the next step begins; plant and shafts do not move until then.
  [[nodiscard]] hal::TimeNs next_step_ns() const { return next_step_ns_; }
  [[nodiscard]] hal::TimeNs step_ns() const { return step_ns_; }
  // Turns the shafts to the joints' positions, runs the devices, and advances the plant by one
  // step.
  void step();
  // Makes a step as step() does, in which no message has arrived: listeners are not run.
  void coast();
  // Returns true if every device is a listener, and there is one.
  [[nodiscard]] bool only_listens() const { return devices_.empty() && !listeners_.empty(); }
  // Returns the descriptors of the listeners in the order in which they were added.
  [[nodiscard]] std::span<const int> descriptors() const { return descriptors_; }
  // Makes every step that begins at `now_ns` or earlier.
  void run(hal::TimeNs now_ns);
  // Leaves out the steps that begin before `now_ns`; the machine does not move in that time.
  void skip_to(hal::TimeNs now_ns);

  // Sets a fault of that joint's drive.
  void set_fault(std::size_t joint, EmulatorFault fault);

  // Returns the state after the last step.
  [[nodiscard]] const MachineTruth& truth() const { return truth_; }
  // Returns the mechanics, for tests.
  [[nodiscard]] const Plant& plant() const { return plant_; }

 private:
  // Makes a step, and runs the listeners in it if `listens`.
  void make_step(bool listens);
  // Notes the true state and turns each shaft by its transmission.
  void turn_shafts();
  // Returns the joints' efforts from the shafts' torques.
  JointEfforts take_torques();
  // Advances plant and hand by one step.
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
  std::vector<std::function<void(hal::TimeNs)>> listeners_;
  std::vector<int> descriptors_;
  MachineTruth truth_;
};

}  // namespace tactus::host
