// The controller: one object in static storage that turns a joint sample into a joint command once
// per tick.
//
// It has no thread and no locks: one thread configures it, loads a scene and then ticks it. No
// member allocates, throws, blocks or prints. World frame W is right-handed, x right, y up, z
// toward the user: the device frame D moved to workspace_origin_D. firmware/README.md describes the
// stages of a tick, the modes and the faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/effort_path.h"
#include "firmware/control/force_path.h"
#include "firmware/control/guards.h"
#include "firmware/control/loaded_scene.h"
#include "firmware/control/mode.h"
#include "firmware/control/mode_machine.h"
#include "firmware/control/next_tick.h"
#include "firmware/control/parameters.h"
#include "firmware/control/tool_locator.h"
#include "firmware/telemetry/record.h"
#include "firmware/telemetry/stopwatch.h"
#include "rendering/state_archive.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

// The reason why a scene was not loaded.
enum class SceneFault : std::uint8_t {
  active,       // the motors are on
  world,        // World::set_scene refused it
  uncertified,  // a part of it is beyond the configuration's certificate
  costly,       // its motions and effects take more than half of a tick's budget
};
// Why a scene was not loaded.
struct SceneRefusal {
  SceneFault fault = SceneFault::active;
  // The part that is too stiff; set if the fault is `uncertified`.
  UncertifiedPart part;
  // The cost units that its motions and effects take, and those of a tick
  // (rendering/tick_budget.h); set if the fault is `costly`.
  std::size_t standing_units = 0;
  std::size_t budget_units = 0;
};

// The controller of one device with one tool.
class Controller {
 public:
  // Takes a configuration and starts anew in mode `init`, with the loaded scene. On an error
  // nothing changes. If the loaded scene is beyond the configuration's certificate, the error's
  // field is "certificate" and its value a stiffness, N/m. A wall of the workspace beyond the
  // certificate is refused too, by the name of its stiffness or its damping, and so is a
  // "tick_instructions" of which the loaded scene's motions and effects take more than half.
  std::expected<void, ConfigError> configure(const ControllerConfig& config);

  // Loads a scene; the memory behind the objects must outlive it. Refused in mode `active`, and if
  // a part of it, or parts that push together or with a wall of the workspace, are stiffer than the
  // certificate allows, unless `allow_uncertified`. Refused, too, if its motions and effects leave
  // less than half of a tick's budget to the contacts. The world then keeps its scene. If the world
  // refuses the scene, the world is empty afterwards.
  std::expected<void, SceneRefusal> load_scene(std::span<const rendering::Object> objects,
                                               const rendering::WorldConfig& config);

  // Changes a parameter from the next tick on, which records the change. Returns the number of that
  // tick. Call it between ticks, at most once per tick, because a record holds one change. On a
  // refusal nothing changes. Real time and bounded, but a certified device checks the scene again
  // for a change of an object (safety/pushing_together.h).
  std::expected<ParameterEvent, ParameterRefusal> set_parameter(const ParameterChange& change);
  // Returns the present value of a parameter and its allowed range. During a gradual change it is
  // the value at the change's end. Call between ticks; real time.
  //   no_such_parameter, no_such_object   there is none of that number
  //   not_of_this_model                   the object's friction has no such term
  [[nodiscard]] std::expected<ParameterValue, ParameterRefusal> parameter(
      const ParameterPlace& place) const;
  // Returns the part that the last `uncertified` set_parameter would have made too stiff.
  [[nodiscard]] const UncertifiedPart& uncertified_part() const { return scene_.refused_part; }

  // Runs one tick and returns the efforts. Equal state and inputs give the same command and record,
  // to the bit. For any input the command is finite and within its limits. Real time.
  drivers::JointCommand tick(const drivers::JointSample& fresh, Request request);

  // Writes all that the next ticks depend on, for restore() in any process and on any processor.
  // Returns the number of bytes, at most kMaxCheckpointBytes for one tool; 0 if the room is too
  // small, nothing is configured, or a number is not finite, as can happen after a fault. Call it
  // between ticks; it copies up to half a megabyte.
  std::size_t save(std::span<std::byte> room);

  // Continues from the state of save(): the next ticks give the same bits. The controller must have
  // the same configuration and scene. Returns false if the bytes do not belong to them; the
  // controller then counts as not configured: configure it and load the scene again.
  bool restore(std::span<const std::byte> bytes);

  // Returns the record of the last tick.
  [[nodiscard]] const TelemetryRecord& record() const { return record_; }
  // Returns the mode after the last tick.
  [[nodiscard]] Mode mode() const { return modes_.mode(); }
  // Returns the configuration with the changes of set_parameter.
  [[nodiscard]] const ControllerConfig& config() const { return settings_.config; }
  // Returns the radius of the tool in the loaded scene, m.
  [[nodiscard]] double tool_radius_m() const { return scene_.tool_radius_m; }
  // Returns the number of the next tick.
  [[nodiscard]] std::uint64_t next_tick() const { return next_.number; }

  // Sets the clock for the record's stage times. Without one they are 0.
  void set_clock(NowNs now_ns) { now_ns_ = now_ns; }
  // Returns the clock of set_clock; null if none was set.
  [[nodiscard]] NowNs clock() const { return now_ns_; }

  // Sets who sees how each touch is computed; null for nobody. It must live as long as ticks run.
  void watch(rendering::TickWatcher* watcher) { scene_.watcher = watcher; }

  // Takes the loop's report for the next tick. The loop calls it before the tick.
  void note_loop(const LoopReport& report) { next_.loop = report; }

  // Takes the status of the device's write and the times of both transfers, ns. The next tick adds
  // the status to that of its sample. The loop calls it after each tick.
  void note_transfers(std::uint32_t write_status, std::uint32_t read_ns, std::uint32_t write_ns);

 private:
  // The configuration, and what of it set_parameter() has changed.
  struct Settings {
    // The configuration with the changes of set_parameter().
    ControllerConfig config;
    // The safety as given to configure(): the ends of the parameters' ranges.
    SafetyConfig configured_safety;
    bool is_configured = false;
  };

  // The stages of a tick; Controller::tick calls them in this order.
  void advance_mode(const TickInputs& inputs, Request request);
  bool locate(const TickInputs& inputs);
  rendering::Touch touch(bool is_located);
  void advance_changes();
  drivers::JointCommand command_joints(const TickInputs& inputs, const Vec3& force_W);
  drivers::JointCommand command_nothing();

  // Each writes a part of the memory to the archive, or reads it back (controller_state.cpp).
  void transfer(rendering::StateArchive& archive);
  void transfer_parameters(rendering::StateArchive& archive);
  void transfer_pose(rendering::StateArchive& archive);
  void transfer_record(rendering::StateArchive& archive);

  // Returns true if the object may have that material and method on this device. Otherwise sets
  // uncertified_part().
  bool is_certified(std::uint32_t object, const rendering::Material& material,
                    rendering::ContactMethod method);
  // Apply a change of an object's friction model or contact method. The value is allowed.
  std::expected<void, ParameterRefusal> choose_model(const ParameterChange& change);
  std::expected<void, ParameterRefusal> choose_contact(const ParameterChange& change);
  // Applies a change of one of the controller's own parameters.
  void apply_own(const ParameterChange& change);
  // Passes changed parameters to the parts that use them, without starting their ramps anew.
  void retune();

  Settings settings_;
  NextTick next_;
  ModeMachine modes_;
  Guards guards_;
  ToolLocator locator_;
  LoadedScene scene_;
  ForcePath force_path_;
  EffortPath effort_path_;
  TelemetryRecord record_;
  NowNs now_ns_ = nullptr;
};

}  // namespace tactus::firmware
