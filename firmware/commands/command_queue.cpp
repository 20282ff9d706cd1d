#include "firmware/commands/command_queue.h"

#include <array>

#include "firmware/control/parameter_name.h"
#include "rendering/scene/scene_world.h"

namespace tactus::firmware {

bool took_effect(Request request, Mode after) {
  switch (request) {
    case Request::none:
      return true;
    case Request::home:
      return after == Mode::homing;
    case Request::enable:
      return after == Mode::active;
    // A disable in `init` or `fault` asks for what is so already.
    case Request::disable:
      return after != Mode::active && after != Mode::homing;
    case Request::reset:
      return after != Mode::fault;
    case Request::estop:
      return after == Mode::fault;
  }
  return false;
}

std::optional<Answer> CommandQueue::post(const Command& command) {
  Answer answer{.ticket = command.ticket, .kind = command.kind, .request = command.request};
  if (command.kind != CommandKind::request) {
    commands_.push(command);
    ++waiting_;
    return std::nullopt;
  }
  const auto [accepted, replaced] =
      requests_.post({.request = command.request, .ticket = command.ticket});
  if (!accepted) {
    answer.outcome = Outcome::estop_waits;
    return answer;
  }
  if (replaced.request == Request::none) {
    return std::nullopt;
  }
  answer.ticket = replaced.ticket;
  answer.request = replaced.request;
  answer.outcome = Outcome::superseded;
  return answer;
}

std::optional<Answer> CommandQueue::next_answer() {
  const Answer* const front = answers_.front();
  if (front == nullptr) {
    return std::nullopt;
  }
  const Answer answer = *front;
  answers_.pop();
  waiting_ -= answer.kind == CommandKind::request ? 0U : 1U;
  return answer;
}

std::optional<Command> CommandQueue::take_request() {
  const TicketedRequest newest = requests_.take();
  if (newest.request == Request::none) {
    return std::nullopt;
  }
  return Command{.kind = CommandKind::request, .ticket = newest.ticket, .request = newest.request};
}

std::optional<Command> CommandQueue::take_command() {
  const Command* const front = commands_.front();
  if (front == nullptr) {
    return std::nullopt;
  }
  const Command command = *front;
  commands_.pop();
  return command;
}

Request CommandQueue::before_tick(Controller& controller) {
  before_ = controller.mode(device_);
  if (const Command* const front = commands_.front(); front != nullptr) {
    // The place is freed before the answer, because the answer allows the next post.
    const Command command = *front;
    commands_.pop();
    carry_out(command, controller);
  }
  pending_ = requests_.take();
  const bool is_stop = stops_.take();
  is_operated_ = is_operated_ || is_stop || pending_.request != Request::none;
  return is_stop ? Request::estop : pending_.request;
}

// A request that fell into the tick of a stop is answered as without effect.
void CommandQueue::after_tick(const Controller& controller) {
  const TelemetryRecord& record = controller.record(device_);
  if (stops_.answer({.tick = record.tick, .after = record.mode})) {
    tell(EventKind::request, record.tick, kRequestNames[static_cast<std::size_t>(Request::estop)],
         0.0);
  }
  if (pending_.request == Request::none) {
    return;
  }
  tell(EventKind::request, record.tick, kRequestNames[static_cast<std::size_t>(pending_.request)],
       0.0);
  answers_.push(
      {.ticket = pending_.ticket,
       .kind = CommandKind::request,
       .outcome = took_effect(pending_.request, record.mode) ? Outcome::done : Outcome::no_effect,
       .request = pending_.request,
       .before = before_,
       .after = record.mode,
       .tick = record.tick,
       .faults = record.faults});
  pending_ = {};
}

void CommandQueue::carry_out(const Command& command, Controller& controller) {
  Answer answer{.ticket = command.ticket,
                .kind = command.kind,
                .before = controller.mode(device_),
                .after = controller.mode(device_),
                .tick = controller.next_tick(),
                .faults = controller.record(device_).faults};
  switch (command.kind) {
    case CommandKind::request:
    case CommandKind::look:
      break;
    case CommandKind::get:
      if (const auto value = controller.parameter(command.change.place, device_)) {
        answer.value = *value;
      } else {
        answer.outcome = Outcome::parameter;
        answer.refusal = value.error();
      }
      break;
    case CommandKind::set:
      set(command, controller, answer);
      break;
    case CommandKind::scene:
      set_scene(command, controller, answer);
      break;
    case CommandKind::inject:
      injector_.start(command.injection);
      tell(EventKind::inject, answer.tick,
           kInjectionTexts[static_cast<std::size_t>(command.injection.injection)].name,
           command.injection.ticks);
      break;
  }
  answers_.push(answer);
}

// The answer holds the new value, or after a refusal the unchanged value and its range.
void CommandQueue::set(const Command& command, Controller& controller, Answer& answer) {
  const auto done = controller.set_parameter(command.change, device_);
  if (!done) {
    answer.outcome = Outcome::parameter;
    answer.refusal = done.error();
    answer.scene_refusal.part = controller.uncertified_part();
  } else {
    std::array<char, kMaxParameterName> name{};
    tell(EventKind::parameter, answer.tick, write_parameter_name(command.change.place, name),
         command.change.value);
  }
  if (const auto value = controller.parameter(command.change.place, device_)) {
    answer.value = *value;
  }
}

void CommandQueue::set_scene(const Command& command, Controller& controller, Answer& answer) {
  const auto loaded =
      controller.load_scene(command.scene->objects(), rendering::world_of(*command.scene));
  if (!loaded) {
    answer.outcome = Outcome::scene;
    answer.scene_refusal = loaded.error();
    return;
  }
  tell(EventKind::scene, answer.tick, kSceneAttachment, 0.0);
}

void CommandQueue::tell(EventKind kind, std::uint64_t tick, std::string_view name,
                        double value) const {
  if (events_.tell == nullptr) {
    return;
  }
  TelemetryEvent event{.tick = tick, .kind = kind, .value = value};
  set_name(event, name);
  events_.tell(events_.to, event);
}

}  // namespace tactus::firmware
