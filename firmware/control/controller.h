// The controller: one object in static storage that turns joint samples into joint commands once
// per tick. It has one device, or several that touch one world.
//
// It has no thread and no locks: one thread configures it, loads a scene and then ticks it. No
// member allocates, throws, blocks or prints. firmware/README.md describes the stages of a tick,
// the modes and the faults.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/device_controller.h"
#include "firmware/control/loaded_scene.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameters.h"
#include "firmware/telemetry/record.h"
#include "firmware/telemetry/stopwatch.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

// The reason why a scene was not loaded.
enum class SceneFault : std::uint8_t {
  active,       // the motors are on
  world,        // World::set_scene refused it
  uncertified,  // a part of it is beyond a device's certificate
  costly,       // its motions and effects take more than half of a tick's budget
  capacity,     // it exceeds a capacity of the profile
};
// Why a scene was not loaded.
struct SceneRefusal {
  SceneFault fault = SceneFault::active;
  // The part that is too stiff, and the device that may not render it, 0 for the first; set if the
  // fault is `uncertified`.
  UncertifiedPart part;
  std::size_t device = 0;
  // The cost units that its motions and effects take, and those of a tick
  // (rendering/tick_budget.h); set if the fault is `costly`.
  std::size_t standing_units = 0;
  std::size_t budget_units = 0;
  // The capacity; set if the fault is `capacity`.
  rendering::ExceededCapacity exceeded;
};

// The controller of one or several devices with one tool each. A device is meant by its number,
// below device_count(); the default is the first one.
class Controller {
 public:
  // Has one device.
  Controller() = default;
  // Has one device, and as many more as both storages have room for, at most kMaxTools in all.
  // The storages must outlive the controller, which must not be copied then.
  Controller(std::span<DeviceController> more_devices, std::span<rendering::ToolSlot> more_tools)
      : more_devices_(more_devices.first(
            std::min({more_devices.size(), more_tools.size(), rendering::kMaxTools - 1}))),
        scene_(more_tools) {}

  // Returns the number of devices.
  [[nodiscard]] std::size_t device_count() const { return 1 + more_devices_.size(); }

  // Takes a configuration and starts the device anew in mode `init`, with the loaded scene, whose
  // contacts and effects start anew for all devices. On an error nothing changes. If the loaded
  // scene is beyond the configuration's certificate, the error's field is "certificate" and its
  // value a stiffness, N/m. A wall of the workspace beyond the certificate is refused too, by the
  // name of its stiffness or its damping, and so is a "tick_instructions" of which the loaded
  // scene's motions and effects take more than half. All devices must have the same "rate_hz". The
  // smallest "tick_instructions" of all counts.
  std::expected<void, ConfigError> configure(const ControllerConfig& config,
                                             std::size_t device = 0);

  // Loads a scene; the memory behind the objects must outlive it. It has as many tools as there are
  // devices, whatever `config` says. Refused if it exceeds a capacity of the profile
  // (rendering/profiles), if a device is in mode `active`, and if a part of it,
  // or parts that push together or with a wall of the workspace, are stiffer than a device's
  // certificate allows, unless `allow_uncertified`. Refused, too, if its motions and effects leave
  // less than half of a tick's budget to the contacts. The world then keeps its scene. If the world
  // refuses the scene, the world is empty afterwards.
  std::expected<void, SceneRefusal> load_scene(std::span<const rendering::Object> objects,
                                               const rendering::WorldConfig& config);

  // Changes a parameter from the next tick on: one of the device's own, or one of an object for all
  // devices. The device's next record contains the change. Returns the number of that tick. Call it
  // between ticks, at most once per tick, because a record holds one change. On a refusal nothing
  // changes. Real time and bounded, but for a certified device the scene is checked again after a
  // change of an object (safety/pushing_together.h).
  std::expected<ParameterEvent, ParameterRefusal> set_parameter(const ParameterChange& change,
                                                                std::size_t device = 0);
  // Returns the present value of a parameter and its allowed range. During a gradual change it is
  // the value at the change's end. Call between ticks; real time.
  //   no_such_parameter, no_such_object   there is none of that number
  //   not_of_this_model                   the object's friction has no such term
  [[nodiscard]] std::expected<ParameterValue, ParameterRefusal> parameter(
      const ParameterPlace& place, std::size_t device = 0) const;
  // Returns the part that the last `uncertified` set_parameter would have made too stiff.
  [[nodiscard]] const UncertifiedPart& uncertified_part() const { return scene_.refused_part; }

  // Runs one tick of all devices: each span has one entry for each. A fault of one device takes the
  // force from the others in the same tick, unless its configuration says `on_fault` = own. Equal
  // state and inputs give the same commands and records, to the bit. For any input the commands are
  // finite and within their limits. Real time.
  void tick(std::span<const drivers::JointSample> samples, std::span<const Request> requests,
            std::span<drivers::JointCommand> commands);
  // Runs one tick of a controller with one device. Returns the efforts.
  drivers::JointCommand tick(const drivers::JointSample& sample, Request request);

  // Writes all that the next ticks depend on, for restore() in any process and on any processor.
  // Returns the number of bytes, at most kMaxCheckpointBytes for one tool; 0 if the room is too
  // small, a device is not configured, or a number is not finite, as can happen after a fault. Call
  // it between ticks; it copies up to half a megabyte.
  std::size_t save(std::span<std::byte> room);

  // Continues from the state of save(): the next ticks give the same bits. The controller must have
  // the same configurations and scene. Returns false if the bytes do not belong to them; every
  // device then counts as not configured: configure it and load the scene again.
  bool restore(std::span<const std::byte> bytes);

  // Returns the record of the device's last tick.
  [[nodiscard]] const TelemetryRecord& record(std::size_t device = 0) const {
    return at(device).record();
  }
  // Returns the device's mode after the last tick.
  [[nodiscard]] Mode mode(std::size_t device = 0) const { return at(device).mode(); }
  // Returns the device's configuration with the changes of set_parameter.
  [[nodiscard]] const ControllerConfig& config(std::size_t device = 0) const {
    return at(device).config();
  }
  // Returns the radius of the tools in the loaded scene, m.
  [[nodiscard]] double tool_radius_m() const { return scene_.tool_radius_m; }
  // Returns the number of the next tick.
  [[nodiscard]] std::uint64_t next_tick() const { return first_device_.next_tick(); }
  // Returns the world of the loaded scene.
  [[nodiscard]] const rendering::World& world() const { return scene_.world; }

  // Sets the clock for the records' stage times. Without one they are 0.
  void set_clock(NowNs now_ns);
  // Returns the clock of set_clock; null if none was set.
  [[nodiscard]] NowNs clock() const { return first_device_.clock(); }

  // Sets who sees how each touch of the device's tool is computed; null for nobody. It must live as
  // long as ticks run.
  void watch(rendering::TickWatcher* watcher, std::size_t device = 0) { at(device).watch(watcher); }

  // Takes the loop's report for the next tick. The loop calls it before the tick.
  void note_loop(const LoopReport& report);

  // Takes the status of the device's write and the times of both transfers, ns. The next tick adds
  // the status to that of its sample. The loop calls it after each tick.
  void note_transfers(std::uint32_t write_status, std::uint32_t read_ns, std::uint32_t write_ns,
                      std::size_t device = 0) {
    at(device).note_transfers(write_status, read_ns, write_ns);
  }

 private:
  [[nodiscard]] DeviceController& at(std::size_t device) {
    return device == 0 ? first_device_ : more_devices_[device - 1];
  }
  [[nodiscard]] const DeviceController& at(std::size_t device) const {
    return device == 0 ? first_device_ : more_devices_[device - 1];
  }

  // The stages of a tick that concern all devices; Controller::tick calls them.
  void stop_together();
  void touch();
  void touch_several();
  void advance_changes();

  void transfer(rendering::StateArchive& archive);

  // Returns true if the object may have that material and method on all devices. Otherwise sets
  // uncertified_part().
  bool is_certified(std::uint32_t object, const rendering::Material& material,
                    rendering::ContactMethod method);
  // Apply a change of an object. The value is allowed.
  std::expected<void, ParameterRefusal> change_object(const ParameterChange& change);
  std::expected<void, ParameterRefusal> choose_model(const ParameterChange& change);
  std::expected<void, ParameterRefusal> choose_contact(const ParameterChange& change);

  DeviceController first_device_;
  std::span<DeviceController> more_devices_;
  LoadedScene scene_;
};

// The storage of the devices beyond the first one, and of their tools.
template <std::size_t kDevices>
struct MoreDevices {
  std::array<DeviceController, kDevices - 1> devices;
  std::array<rendering::ToolSlot, kDevices - 1> tools;
};

// A controller of `kDevices` devices, in the storage of its owner.
template <std::size_t kDevices>
class ControllerOf : private MoreDevices<kDevices>, public Controller {
  static_assert(kDevices >= 1 && kDevices <= rendering::kMaxTools);

 public:
  ControllerOf() : Controller(this->devices, this->tools) {}
  ControllerOf(const ControllerOf&) = delete;
  ControllerOf& operator=(const ControllerOf&) = delete;
  ~ControllerOf() = default;
};

}  // namespace tactus::firmware
