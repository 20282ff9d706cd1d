// The controller of one device with one tool, without the scene. Controller has one for each
// device, and calls the stages of a tick in the order in which they stand here.
//
// It has no thread and no locks. No member allocates, throws, blocks or prints. World frame W is
// right-handed, x right, y up, z toward the user: the device frame D moved to workspace_origin_D.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/effort_path.h"
#include "firmware/control/force_path.h"
#include "firmware/control/guards.h"
#include "firmware/control/mode.h"
#include "firmware/control/mode_machine.h"
#include "firmware/control/next_tick.h"
#include "firmware/control/parameters.h"
#include "firmware/control/tool_locator.h"
#include "firmware/telemetry/record.h"
#include "firmware/telemetry/stopwatch.h"
#include "rendering/state_archive.h"
#include "rendering/touch.h"

namespace tactus::rendering {
class TickWatcher;
}

namespace tactus::firmware {

// The guards, limits, mode and record of one device.
class DeviceController {
 public:
  // Takes a valid configuration and starts anew in mode `init`.
  void configure(const ControllerConfig& config);
  [[nodiscard]] bool is_configured() const { return settings_.is_configured; }

  // Sets one of the controller's own parameters; the value must be in the range that
  // own_parameter() returns.
  void set_own(const ParameterChange& change);
  // Returns one of the controller's own parameters with its range.
  [[nodiscard]] ParameterValue own_parameter(Parameter parameter) const;
  // Lets the record of the next tick contain the change, and returns it with that tick's number.
  ParameterEvent record_change(const ParameterChange& change);

  // Begins a tick: opens the record, checks the inputs and advances the mode. Returns true if the
  // joints' zero has moved, so that the tool starts without contact.
  bool begin(const drivers::JointSample& fresh, Request request);
  // Stops this device because another one has a fault, the `device`-th of the controller. It may be
  // called between any two stages of a tick, whose command is then without power.
  void stop_for(std::size_t device);
  // Computes the tool's position and velocity, and checks them.
  void locate();
  // Takes what the tool touches. `touch` is free_touch() unless touches().
  void take(const rendering::Touch& touch);
  // Limits the force for a hand and distributes it to the joints.
  void drive();
  // Ends the tick. Returns its command.
  drivers::JointCommand close();

  // Returns the tool of this tick; without a place it is where it was, at rest.
  [[nodiscard]] const rendering::ToolState& tool() const { return locator_.tool; }
  // Returns true if the tool touches the scene in this tick. It does so in `ready` too, without
  // force: the proxy then rests on the surface into which the tool is pushed, and activation raises
  // the force from there.
  [[nodiscard]] bool touches() const {
    return tick_.is_located && (modes_.mode() == Mode::ready || modes_.mode() == Mode::active);
  }
  // Returns the faults that it has found itself and that stop the other devices, too.
  [[nodiscard]] std::uint64_t faults_for_all() const;
  // Returns by how much a change of a material may change the force in a tick, N: no faster than an
  // activation with the largest force.
  [[nodiscard]] double largest_change_N() const;
  // Notes that such a change is not complete.
  void note_change();

  // The same as those of Controller, for one device.
  [[nodiscard]] const TelemetryRecord& record() const { return record_; }
  [[nodiscard]] Mode mode() const { return modes_.mode(); }
  [[nodiscard]] const ControllerConfig& config() const { return settings_.config; }
  [[nodiscard]] std::uint64_t next_tick() const { return next_.number; }
  void set_clock(NowNs now_ns) { now_ns_ = now_ns; }
  [[nodiscard]] NowNs clock() const { return now_ns_; }
  void watch(rendering::TickWatcher* watcher) { watcher_ = watcher; }
  [[nodiscard]] rendering::TickWatcher* watcher() const { return watcher_; }
  void note_loop(const LoopReport& report) { next_.loop = report; }
  void note_transfers(std::uint32_t write_status, std::uint32_t read_ns, std::uint32_t write_ns);

  // Writes the memory to the archive, or reads it back (controller_state.cpp).
  void transfer(rendering::StateArchive& archive);
  // Counts as not configured from now on, until configure().
  void forget_configuration() { settings_.is_configured = false; }

 private:
  // The configuration, and what of it set_own() has changed.
  struct Settings {
    // The configuration with the changes of set_own().
    ControllerConfig config;
    // The safety as given to configure(): the ends of the parameters' ranges.
    SafetyConfig configured_safety;
    bool is_configured = false;
  };
  // The tick between begin() and close(). Nothing of it outlives the tick.
  struct TickInProgress {
    NextTick now;
    drivers::JointSample sample;
    Stopwatch watch{nullptr};
    rendering::Touch touch;
    // The efforts, and the part of them that renders: a force, N. They go out if the tick ends in
    // `active`.
    drivers::JointCommand command;
    Vec3 force_W = Vec3::Zero();
    bool is_located = false;
  };

  [[nodiscard]] TickInputs inputs() const;
  bool advance_mode(Request request);
  bool find_tool();
  void distribute(const Vec3& force_W);
  // Passes changed parameters to the parts that use them, without starting their ramps anew.
  void retune();

  void transfer_parameters(rendering::StateArchive& archive);
  void transfer_pose(rendering::StateArchive& archive);
  void transfer_record(rendering::StateArchive& archive);

  Settings settings_;
  NextTick next_;
  ModeMachine modes_;
  Guards guards_;
  ToolLocator locator_;
  ForcePath force_path_;
  EffortPath effort_path_;
  TelemetryRecord record_;
  TickInProgress tick_;
  NowNs now_ns_ = nullptr;
  rendering::TickWatcher* watcher_ = nullptr;
};

}  // namespace tactus::firmware
