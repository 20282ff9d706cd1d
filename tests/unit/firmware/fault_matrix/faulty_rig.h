// A controller, a floor and a device in memory that can be made to fail in any mode, alone or
// beside a companion.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "firmware/control/controller.h"
#include "firmware/control/run_tick.h"
#include "firmware/safety/faults.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {

// Reports what it is told to and keeps what it was commanded. Three axes; the hand is at `sample`.
class ScriptedDevice {
 public:
  [[nodiscard]] static std::size_t joint_count() { return kJointCount; }
  void read(drivers::JointSample& out) const {
    out = sample;
    if (measures_effort && sample.effort_known == 0) {
      out.effort = written.effort;
      out.effort_known = 0b111;
      out.effort_is_new = 0b111;
    }
  }
  std::uint32_t write(const drivers::JointCommand& command) {
    written = command;
    return write_status;
  }
  void clear_faults() {}
  [[nodiscard]] bool has_torque() const {
    return written.enable ||
           std::ranges::any_of(written.effort, [](double effort) { return effort != 0.0; });
  }

  drivers::JointSample sample;
  bool measures_effort = false;  // its drives report the effort that they were commanded
  std::uint32_t write_status = drivers::kDeviceOk;
  drivers::JointCommand written;
};

class FaultyRig {
 public:
  // One device alone.
  FaultyRig() : FaultyRig(1, OnFault::all) {}
  // One or two devices; the first one's faults stop those.
  FaultyRig(std::size_t devices, OnFault on_fault);

  // Starts over, and goes to that mode with the tool 2 mm in the floor; in `active` until the soft
  // start is over. False if it did not get there. The companion has got to `active` before.
  bool enter(Mode mode, std::uint64_t guards_off);

  // The device as it is without a fault in the mode that was entered.
  void heal();

  void tick(Request request = Request::none, Request of_companion = Request::none);
  [[nodiscard]] const TelemetryRecord& record(std::size_t number = 0) const {
    return controller_.record(number);
  }
  [[nodiscard]] bool has_torque() const { return device.has_torque(); }
  Controller& controller() { return controller_; }

  ScriptedDevice device;
  // The second device. It presses on the floor beside the first one, and is never quite still.
  ScriptedDevice companion;

 private:
  bool start_companion();

  Floor floor_{{.stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0, .friction = {}}};
  OnFault on_fault_;
  std::array<DeviceController, 1> more_devices_;
  std::array<rendering::ToolSlot, 1> more_tools_;
  Controller controller_;
  std::uint64_t ticks_ = 0;
  bool is_homing_ = false;
};

// A fault, how to inject it, and the reaction of the controller that is expected.
struct MatrixFault {
  std::string_view name;
  FaultBits bit;
  std::uint8_t modes;  // those that raise it, 1 << Mode; in the others nothing happens
  int ticks;           // with the fault in them until it is certain; torque may last one longer
  void (*inject)(FaultyRig& rig, int tick);  // before each tick
  Request request = Request::none;           // with each tick
};

// Returns what is wrong with a cell of the matrix, or an empty text.
std::string check_cell(FaultyRig& rig, const MatrixFault& fault, Mode mode,
                       std::uint64_t guards_off);

}  // namespace tactus::firmware
