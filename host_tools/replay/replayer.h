// A controller that lives a recorded run once more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "firmware/control/controller.h"
#include "firmware/telemetry/record.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

struct ReplaySetup {
  firmware::ControllerConfig config;
  std::span<const rendering::Object> objects;  // none: no scene; outlive the replay
  rendering::WorldConfig world;
};

// A field in which a replayed tick differs from the recorded one.
struct Difference {
  std::uint64_t tick = 0;
  std::string field;  // as in TelemetryRecord, with its element: tool_p_W.y, joint_effort[2]
  std::string recorded;
  std::string replayed;
};

// Returns the first field that differs, in their order, bit by bit; stage times may differ. It is
// `state_hash` if all others are equal: then an earlier tick differed, or the record was changed.
std::optional<Difference> first_difference(const firmware::TelemetryRecord& recorded,
                                           const firmware::TelemetryRecord& replayed);

// One thread.
class Replayer {
 public:
  // The replayer begins at the moment before tick 0. Throws InputError if the controller refuses
  // configuration or scene.
  explicit Replayer(const ReplaySetup& setup);

  // Takes another scene, which outlives the replay, before the next tick. Throws InputError if the
  // controller refuses it.
  void use_scene(const rendering::SceneImage& scene);

  // Goes to the moment of a state that Controller::save wrote. Throws InputError if the state is
  // not of this configuration and scene.
  void go_to(std::span<const std::byte> state);

  // Repeats the recorded tick. Returns the difference if the hashes differ.
  std::optional<Difference> repeat(const firmware::TelemetryRecord& recorded);

  // The number of the tick to come.
  [[nodiscard]] std::uint64_t next_tick() const { return controller_->next_tick(); }
  // Returns the record of the last tick.
  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller_->record(); }
  [[nodiscard]] firmware::Controller& controller() { return *controller_; }

 private:
  std::unique_ptr<firmware::Controller> controller_;
};

}  // namespace tactus::host
