// What the command thread hands to the tick, and what the tick answers. Fixed size, copied.
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

enum class CommandKind : std::uint8_t { request, look, get, set, scene, inject };

// `look` asks for nothing but the mode.
struct Command {
  CommandKind kind = CommandKind::look;
  Ticket ticket = 0;
  Request request = Request::none;               // of `request`
  ParameterChange change;                        // of `set`; its place alone of `get`
  const rendering::SceneImage* scene = nullptr;  // of `scene`: alive until it is answered
  InjectionOrder injection;                      // of `inject`
};

enum class Outcome : std::uint8_t {
  done,
  superseded,   // a newer request came before the next tick
  estop_waits,  // an estop has not been taken yet
  no_effect,    // of a request: `after` says where the mode is
  parameter,    // refused, `refusal` says why
  scene,        // refused, `scene_refusal` says why
};

struct Answer {
  Ticket ticket = 0;
  CommandKind kind = CommandKind::look;
  Outcome outcome = Outcome::done;
  Request request = Request::none;  // of `request`
  Mode before = Mode::init;         // of the tick
  Mode after = Mode::init;
  ParameterRefusal refusal = ParameterRefusal::no_such_parameter;
  std::uint64_t tick = 0;  // that was the first to have it
  std::uint64_t faults = 0;
  ParameterValue value;        // of `get` and `set`
  SceneRefusal scene_refusal;  // its part is of `set` too, if that was uncertified
};
static_assert(std::is_trivially_copyable_v<Command> && std::is_trivially_copyable_v<Answer>);

}  // namespace tactus::firmware
