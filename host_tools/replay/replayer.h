// Gives a controller the inputs of recorded ticks and compares its outputs with the recorded ones,
// bit for bit. replay.h and what_if.h drive it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware/control/controller.h"
#include "firmware/telemetry/record.h"
#include "host_tools/heap_controller.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// The configuration and scene with which a recorded run began.
struct ReplaySetup {
  // The configuration with which the run began.
  firmware::ControllerConfig config;
  // The scene's objects, the same for all devices of a run; empty for a run without a scene. They
  // must outlive the replay.
  std::span<const rendering::Object> objects;
  // The scene's settings that belong to no object.
  rendering::WorldConfig world;
};

// A field in which a replayed tick differs from the recorded one.
struct Difference {
  // The tick's number in the recording.
  std::uint64_t tick = 0;
  // The device, 0 for the run's first one.
  std::size_t device = 0;
  // The name of the field in TelemetryRecord with its element, such as tool_p_W.y or
  // joint_effort[2].
  std::string field;
  // Both values in the shortest decimal form that gives back the same bits.
  std::string recorded;
  std::string replayed;
};

// Returns the first field, in the record's order, in which the two records differ bit by bit; stage
// times are times of a machine and may differ. The result is `state_hash` if every other field is
// equal: the difference then lies in an earlier tick, or the record was changed.
std::optional<Difference> first_difference(const firmware::TelemetryRecord& recorded,
                                           const firmware::TelemetryRecord& replayed);

// A controller that repeats recorded ticks. One thread.
class Replayer {
 public:
  // Configures a controller of one device as it was before tick 0. Throws InputError if the
  // controller refuses the configuration or the scene.
  explicit Replayer(const ReplaySetup& setup) : Replayer(std::span(&setup, 1)) {}
  // Configures a controller of several devices, 1 to kMaxTools; the scene is the first one's.
  explicit Replayer(std::span<const ReplaySetup> devices);

  // Changes to another scene before the next tick; `scene` must outlive the replay. Throws
  // InputError if the controller refuses it.
  void use_scene(const rendering::SceneImage& scene);

  // Restores a state that Controller::save() wrote. Throws InputError if it does not fit the
  // configuration and scene, or is of another version of the program.
  void go_to(std::span<const std::byte> state);

  // Repeats a tick with the recorded inputs. Returns the first difference if the state hashes
  // differ.
  std::optional<Difference> repeat(const firmware::TelemetryRecord& recorded) {
    return repeat(std::span(&recorded, 1));
  }
  // Repeats a tick of all devices, with a record of each.
  std::optional<Difference> repeat(std::span<const firmware::TelemetryRecord> recorded);

  // Returns the number of the tick to come.
  [[nodiscard]] std::uint64_t next_tick() const { return controller_->next_tick(); }
  // Returns the record of the last tick.
  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller_->record(); }
  // Returns the controller, to change parameters between ticks.
  [[nodiscard]] firmware::Controller& controller() { return *controller_; }

 private:
  HeapController controller_;
};

}  // namespace tactus::host
