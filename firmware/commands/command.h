// A command from the command thread to the tick, and the tick's answer. Both have a fixed size and
// are copied through the rings of command_queue.h.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware/commands/injection.h"
#include "firmware/commands/request_slot.h"
#include "firmware/control/controller.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameters.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {

// The kinds of commands. `look` changes nothing: it asks for the mode.
enum class CommandKind : std::uint8_t { request, look, get, set, scene, inject };

// One command. `kind` says which of the other fields are used; `look` uses none, because every
// answer holds the mode.
struct Command {
  CommandKind kind = CommandKind::look;
  // The number that the answer carries, too.
  Ticket ticket = 0;
  Request request = Request::none;  // used by `request`
  // Used by `set`; `get` uses its place only.
  ParameterChange change;
  // Used by `scene`. It must live until the answer.
  const rendering::SceneImage* scene = nullptr;
  InjectionOrder injection;  // used by `inject`
};

// The result of a command.
enum class Outcome : std::uint8_t {
  done,
  // Refused: a newer request came before the next tick.
  superseded,
  // Refused: an estop waits for its tick and comes first.
  estop_waits,
  // The request does not change the mode `after`.
  no_effect,
  // Refused: `refusal` says why.
  parameter,
  // Refused: `scene_refusal` says why.
  scene,
};

// A tick's answer. Ticket, kind and request are those of the command.
struct Answer {
  Ticket ticket = 0;
  CommandKind kind = CommandKind::look;
  Outcome outcome = Outcome::done;
  Request request = Request::none;  // set by `request`
  // The mode before the tick.
  Mode before = Mode::init;
  // The mode after the tick.
  Mode after = Mode::init;
  ParameterRefusal refusal = ParameterRefusal::no_such_parameter;
  // The number of the first tick that had the command.
  std::uint64_t tick = 0;
  // The fault bits after that tick (safety/faults.h).
  std::uint64_t faults = 0;
  // The value and its range; set by `get` and `set`.
  ParameterValue value;
  // Set by `scene`; `set` fills `part` when the value is uncertified.
  SceneRefusal scene_refusal;
};
static_assert(std::is_trivially_copyable_v<Command> && std::is_trivially_copyable_v<Answer>);

}  // namespace tactus::firmware
