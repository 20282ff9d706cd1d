#include "firmware/linux/commands/command_processor.h"

#include <algorithm>
#include <cstring>

#include "firmware/linux/commands/reply.h"

namespace tactus::firmware {
namespace {

// A command that no tick has answered within this time is refused: the loop has stopped.
constexpr hal::TimeNs kMostWait_ns = hal::kNsPerSecond;

constexpr std::string_view kHelp =
    "ok help: home | enable | disable | reset | estop | status | list | get NAME | set NAME VALUE "
    "| scene FILE | record on FILE | record off | inject FAULT [TICKS]";

constexpr std::string_view kOfFirstDevice =
    "the scene and its objects belong to the first device; send it there, without --device";

// Returns the place of the parameter at `index` of a list: the controller's own parameters come
// first, then those of each object. Returns nothing beyond the last.
std::optional<ParameterPlace> listed_place(std::size_t index, std::size_t objects) {
  const auto own = static_cast<std::size_t>(std::ranges::count_if(
      kParameterTexts, [](const ParameterText& text) { return !is_of_object(text.parameter); }));
  if (index < own) {
    return ParameterPlace{.parameter = kParameterTexts[index].parameter};
  }
  const std::size_t of_object = kParameterTexts.size() - own;
  const std::size_t object = (index - own) / of_object;
  if (object >= objects) {
    return std::nullopt;
  }
  return ParameterPlace{.parameter = kParameterTexts[own + (index - own) % of_object].parameter,
                        .object = static_cast<std::uint32_t>(object)};
}

}  // namespace

void CommandProcessor::configure(const RunHooks& hooks, bool allow_inject) {
  hooks_ = hooks;
  allow_inject_ = allow_inject;
}

void CommandProcessor::take(CommandClient& client, std::string_view line) {
  // A reply repeats at most this much of a word that nobody knows.
  constexpr std::size_t kMostOfAWord = 32;
  const std::string_view word = first_word(line).substr(0, kMostOfAWord);
  if (word.empty()) {
    return;
  }
  const auto command = parse_command(line);
  if (!command) {
    refuse(client, word, command.error());
    return;
  }
  client.waiting = {.verb = command->verb};
  carry_out(client, *command);
}

void CommandProcessor::raise_estop() {
  const auto replaced = queue_.post({.kind = CommandKind::request, .request = Request::estop});
  if (replaced) {
    deliver(*replaced);
  }
}

void CommandProcessor::carry_out(CommandClient& client, const CommandLine& command) {
  switch (command.verb) {
    case Verb::request:
      if (command.request == Request::enable && !hooks_.enable_refusal.empty()) {
        refuse(client, "enable", hooks_.enable_refusal);
        break;
      }
      ask(client, {.kind = CommandKind::request, .request = command.request});
      break;
    case Verb::set:
    case Verb::get:
      ask_parameter(client, command);
      break;
    case Verb::list:
      ask_next_of_list(client);
      break;
    case Verb::status:
      ask(client, {.kind = CommandKind::look});
      break;
    case Verb::scene:
      ask_scene(client, command.file);
      break;
    case Verb::record:
      switch_recording(client, command.file);
      break;
    case Verb::inject:
      if (!allow_inject_) {
        refuse(client, "inject", hooks_.inject_refusal);
        break;
      }
      ask(client, {.kind = CommandKind::inject, .injection = command.injection});
      break;
    case Verb::help:
      client.out().add(kHelp).end();
      break;
  }
}

void CommandProcessor::ask(CommandClient& client, Command command) {
  last_ticket_ = last_ticket_ % kLargestTicket + 1;
  command.ticket = last_ticket_;
  client.waiting.ticket = command.ticket;
  client.waiting.command = command;
  client.waiting.is_posted = false;
  client.waiting.is_under_way = true;
  client.waiting.deadline_ns = now_ns_ + kMostWait_ns;
  post(client);
}

// Posts the client's command. If the queue is full of commands of clients that have gone, the
// command waits in the client and look_after tries again.
void CommandProcessor::post(CommandClient& client) {
  CommandClient::Waiting& waiting = client.waiting;
  if (waiting.command.kind != CommandKind::request && !queue_.has_room()) {
    return;
  }
  waiting.is_posted = true;
  if (const auto known = queue_.post(waiting.command)) {
    deliver(*known);
  }
}

void CommandProcessor::ask_parameter(CommandClient& client, const CommandLine& command) {
  ParameterPlace place{.parameter = command.name.parameter};
  if (!command.name.object.empty()) {
    if (scenes_ == nullptr) {
      refuse(client, word_of(client.waiting), kOfFirstDevice);
      return;
    }
    auto number = object_number(command.name.object);
    number = number ? number : scenes_->find_object(command.name.object);
    if (!number) {
      refuse(client, word_of(client.waiting), describe(ParameterRefusal::no_such_object));
      return;
    }
    place.object = *number;
  }
  ask(client, {.kind = command.verb == Verb::set ? CommandKind::set : CommandKind::get,
               .change = {.place = place, .value = command.value}});
}

// Asks for the mode before it opens the file: no command is carried out while a file is read, so a
// file is never read while the motors have power.
void CommandProcessor::ask_scene(CommandClient& client, std::string_view file) {
  if (!hooks_.scene_refusal.empty()) {
    refuse(client, "scene", hooks_.scene_refusal);
    return;
  }
  if (scenes_ == nullptr) {
    refuse(client, "scene", kOfFirstDevice);
    return;
  }
  std::ranges::copy(file, client.waiting.file.begin());
  client.waiting.is_asking = true;
  ask(client, {.kind = CommandKind::look});
}

void CommandProcessor::hand_scene_over(CommandClient& client, const Answer& answer) {
  client.waiting.is_asking = false;
  if (answer.after == Mode::active) {
    refuse(client, "scene", "the mode is active; send disable first");
    return;
  }
  if (answer.after == Mode::homing) {
    refuse(client, "scene", "homing is under way; wait until the mode is ready");
    return;
  }
  if (scene_ticket_ != 0) {
    refuse(client, "scene", "another scene is on its way to the loop; send it again");
    return;
  }
  const auto opened = scenes_->open_next(client.waiting.file.data());
  if (!opened) {
    const SceneStoreError& error = opened.error();
    client.out().add("refused scene: ").add(client.waiting.file.data()).add(": ").add(error.what);
    if (error.errno_value != 0) {
      client.out().add(": ").add(std::strerror(error.errno_value));
    }
    client.out().end();
    client.waiting.is_under_way = false;
    return;
  }
  now_ns_ = hal::monotonic_now_ns();
  // The queue has room, because an answer has just been taken.
  ask(client, {.kind = CommandKind::scene, .scene = *opened});
  scene_ticket_ = client.waiting.ticket;
}

void CommandProcessor::ask_next_of_list(CommandClient& client) {
  const std::size_t objects = scene() == nullptr ? 0 : scene()->objects().size();
  const auto place = listed_place(client.waiting.listed, objects);
  if (!place) {
    client.out().add("ok list").end();
    client.waiting.is_under_way = false;
    return;
  }
  ++client.waiting.listed;
  ask(client, {.kind = CommandKind::get, .change = {.place = *place}});
}

void CommandProcessor::switch_recording(CommandClient& client, std::string_view file) {
  if (hooks_.start_recording == nullptr || hooks_.stop_recording == nullptr) {
    refuse(client, "record", "nothing here records");
    return;
  }
  const std::string_view wrong =
      file.empty() ? hooks_.stop_recording(hooks_.run) : hooks_.start_recording(hooks_.run, file);
  if (!wrong.empty()) {
    refuse(client, "record", wrong);
    return;
  }
  // The answer gives the tick by which the recording changed.
  ask(client, {.kind = CommandKind::look});
}

void CommandProcessor::look_after(CommandClient& client) {
  CommandClient::Waiting& waiting = client.waiting;
  if (waiting.is_under_way && now_ns_ > waiting.deadline_ns) {
    waiting.ticket = 0;
    refuse_waiting(client, "the loop has not answered for a second; see its log");
  } else if (waiting.is_under_way && waiting.ticket != 0 && !waiting.is_posted) {
    post(client);
  } else if (waiting.is_under_way && waiting.verb == Verb::list && waiting.ticket == 0 &&
             client.has_sent()) {
    ask_next_of_list(client);
  }
}

void CommandProcessor::refuse_waiting(CommandClient& client, std::string_view why) {
  refuse(client, word_of(client.waiting), why);
}

void CommandProcessor::refuse(CommandClient& client, std::string_view command,
                              std::string_view why) {
  write_refusal(client.out(), command, why);
  client.waiting.is_under_way = false;
}

void CommandProcessor::deliver_answers() {
  while (const auto answer = queue_.next_answer()) {
    deliver(*answer);
  }
}

void CommandProcessor::deliver(const Answer& answer) {
  take_over_scene(answer);
  const bool is_stop = answer.kind == CommandKind::request && answer.request == Request::estop;
  // An estop that a newer one has replaced is answered with that one.
  if (is_stop && answer.outcome == Outcome::superseded) {
    return;
  }
  for (CommandClient& client : clients_) {
    const CommandClient::Waiting& waiting = client.waiting;
    const bool for_it = waiting.ticket != 0 && waiting.ticket == answer.ticket;
    const bool waits_for_stop = waiting.ticket != 0 && waiting.verb == Verb::request &&
                                waiting.command.request == Request::estop && is_stop;
    if (client.is_connected() && waiting.is_under_way && (for_it || waits_for_stop)) {
      client.waiting.ticket = 0;
      reply(client, answer);
    }
  }
}

// Takes over the scene also when the client that asked for it has gone.
void CommandProcessor::take_over_scene(const Answer& answer) {
  if (answer.kind != CommandKind::scene || answer.ticket != scene_ticket_) {
    return;
  }
  scene_ticket_ = 0;
  if (answer.outcome != Outcome::done) {
    if (const rendering::SceneImage* const next = scenes_->next_scene(); next != nullptr) {
      refused_names_ = names_of(answer.scene_refusal.part, *next);
    }
    scenes_->drop_next();
    return;
  }
  if (hooks_.scene_changed != nullptr) {
    hooks_.scene_changed(hooks_.run, scenes_->next_bytes());
  }
  scenes_->use_next();
}

}  // namespace tactus::firmware
