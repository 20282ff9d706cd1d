// A command from the command thread to the tick, and the tick's answer. Both have a fixed size and
// are copied.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/control/controller.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameters.h"
#include "firmware/linux/commands/injection.h"
#include "firmware/linux/commands/request_slot.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {

enum class CommandKind : std::uint8_t { request, look, get, set, scene, inject };

// One command. `kind` says which of the other fields are used; `look` uses none, because every
// answer holds the mode.
struct Command {
  CommandKind kind = CommandKind::look;
  Ticket ticket = 0;                             // the answer carries the same number
  Request request = Request::none;               // used by `request`
  ParameterChange change;                        // used by `set`; `get` uses its place only
  const rendering::SceneImage* scene = nullptr;  // used by `scene`; must live until the answer
  InjectionOrder injection;                      // used by `inject`
};

enum class Outcome : std::uint8_t {
  done,
  superseded,   // refused: a newer request came before the next tick
  estop_waits,  // refused: an estop waits for its tick and comes first
  no_effect,    // the request does not change the mode `after`
  parameter,    // refused: `refusal` says why
  scene,        // refused: `scene_refusal` says why
};

struct Answer {
  Ticket ticket = 0;
  CommandKind kind = CommandKind::look;
  Outcome outcome = Outcome::done;
  Request request = Request::none;  // set by `request`
  Mode before = Mode::init;         // the mode before the tick
  Mode after = Mode::init;          // the mode after it
  ParameterRefusal refusal = ParameterRefusal::no_such_parameter;
  std::uint64_t tick = 0;      // number of the first tick that had the command
  std::uint64_t faults = 0;    // fault bits after that tick (safety/faults.h)
  ParameterValue value;        // set by `get` and `set`
  SceneRefusal scene_refusal;  // set by `scene`; `set` fills `part` when the value is uncertified
};
static_assert(std::is_trivially_copyable_v<Command> && std::is_trivially_copyable_v<Answer>);

}  // namespace tactus::firmware
