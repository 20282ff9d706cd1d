#include "firmware/commands/command_server.h"

#include <poll.h>
#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "firmware/commands/reply.h"
#include "firmware/tactusd/certificate_words.h"

namespace tactus::firmware {
namespace {

// While somebody waits for a tick, its answer is looked for so often; else the end of the program.
constexpr hal::TimeNs kLookForAnswer_ns = 1'000'000;
constexpr hal::TimeNs kLookForEnd_ns = 100'000'000;
// A loop that takes longer over a tick has stopped.
constexpr hal::TimeNs kMostWait_ns = hal::kNsPerSecond;
// A checked scene is half a megabyte, and is handed over by value.
constexpr std::size_t kThreadStack_bytes = std::size_t{4} << 20;
static_assert(sizeof(rendering::SceneImage) < kThreadStack_bytes / 6);

constexpr std::string_view kHelp =
    "ok help: home | enable | disable | reset | estop | status | list | get NAME | set NAME VALUE "
    "| scene FILE | record on FILE | record off | inject FAULT [TICKS]";

// The parameters in the order of `list`: the controller's own, then object by object.
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

std::string_view word_of(const CommandClient::Waiting& waiting) {
  switch (waiting.verb) {
    case Verb::request:
      return kRequestNames[static_cast<std::size_t>(waiting.request)];
    case Verb::set:
      return "set";
    case Verb::get:
      return "get";
    case Verb::list:
      return "list";
    case Verb::status:
      return "status";
    case Verb::scene:
      return "scene";
    case Verb::record:
      return "record";
    case Verb::inject:
      return "inject";
    case Verb::help:
      return "help";
  }
  return {};
}

bool is_estop(std::string_view line) {
  const auto command = parse_command(line);
  return command && command->request == Request::estop;
}

}  // namespace

std::expected<void, ListenError> CommandServer::start(const CommandServerConfig& config) {
  config_ = config;
  if (auto open = socket_.open(config.socket_path, config.group); !open) {
    return open;
  }
  pthread_attr_t attributes{};
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kThreadStack_bytes);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  const int error = pthread_create(&thread_, &attributes, run_thread, this);
  pthread_attr_destroy(&attributes);
  if (error != 0) {
    socket_.close();
    return std::unexpected(ListenError{.what = "the system gives no thread", .errno_value = error});
  }
  is_running_ = true;
  return {};
}

void CommandServer::stop() {
  if (!is_running_) {
    return;
  }
  is_ending_.store(true, std::memory_order_relaxed);
  pthread_join(thread_, nullptr);
  is_running_ = false;
  is_ending_.store(false, std::memory_order_relaxed);
  socket_.close();
}

void* CommandServer::run_thread(void* server) {
  static_cast<CommandServer*>(server)->run();
  return nullptr;
}

void CommandServer::run() {
  while (!is_ending_.load(std::memory_order_relaxed)) {
    turn();
  }
  say_goodbye();
}

void CommandServer::turn() {
  wait();
  now_ns_ = hal::monotonic_now_ns();
  for (CommandClient& client : clients_) {
    listen_to(client);
  }
  while (const auto answer = desk_.next_answer()) {
    deliver(*answer);
  }
  for (CommandClient& client : clients_) {
    if (client.is_connected()) {
      serve(client);
    }
  }
  if ((polled_.back().revents & POLLIN) != 0) {
    welcome();
  }
}

// Until there is something to do.
void CommandServer::wait() {
  hal::TimeNs wait_ns = kLookForEnd_ns;
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    const CommandClient& client = clients_[i];
    const bool is_busy = client.waiting.is_under_way;
    const bool has_more = client.line().has_value() && client.has_sent();
    wait_ns = is_busy ? std::min(wait_ns, kLookForAnswer_ns) : has_more ? 0 : wait_ns;
    const auto listens = static_cast<short>(client.listens() ? POLLIN : 0);
    const auto sends = static_cast<short>(client.has_sent() ? 0 : POLLOUT);
    polled_[i] = {.fd = listens != 0 || sends != 0 ? client.descriptor() : -1,
                  .events = static_cast<short>(listens | sends)};
  }
  polled_.back() = {.fd = socket_.descriptor(), .events = POLLIN};
  hal::wait_for_descriptors(polled_, hal::monotonic_now_ns() + wait_ns);
}

void CommandServer::welcome() {
  hal::FileDescriptor socket = socket_.accept();
  if (socket.is_open()) {
    CommandClient& client = place_for_one_more();
    client.connect(std::move(socket));
    client.last_heard_ns = now_ns_;
  }
}

// The one that has been silent longest makes room, so that an estop always finds the door open.
CommandClient& CommandServer::place_for_one_more() {
  const auto heard = [](const CommandClient& client) {
    return client.is_connected() ? client.last_heard_ns : hal::TimeNs{0};
  };
  CommandClient& client = *std::ranges::min_element(clients_, {}, heard);
  if (client.is_connected() && client.has_sent()) {
    refuse(client, "connection", "another program needed the place; connect again");
    client.send(now_ns_);
  }
  return client;
}

void CommandServer::say_goodbye() {
  for (CommandClient& client : clients_) {
    if (client.is_connected() && client.waiting.is_under_way && client.has_sent()) {
      refuse(client, word_of(client.waiting), "the program ends");
      client.send(now_ns_);
    }
    client.disconnect();
  }
}

// An estop is raised as soon as it is heard, whatever its program still waits for.
void CommandServer::listen_to(CommandClient& client) {
  const auto i = static_cast<std::size_t>(&client - clients_.data());
  if (!client.is_connected() || !client.listens() || polled_[i].revents == 0) {
    return;
  }
  client.last_heard_ns = now_ns_;
  if (!client.receive()) {
    client.disconnect();
    return;
  }
  std::string_view rest = client.received();
  for (auto end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    if (is_estop(rest.substr(0, end))) {
      const auto replaced = desk_.post({.kind = CommandKind::request, .request = Request::estop});
      if (replaced) {
        deliver(*replaced);
      }
      return;
    }
    rest.remove_prefix(end + 1);
  }
}

void CommandServer::serve(CommandClient& client) {
  if (client.waiting.is_under_way && now_ns_ > client.waiting.deadline_ns) {
    give_up(client);
  }
  if (client.has_sent()) {
    if (client.waiting.is_under_way) {
      if (client.waiting.verb == Verb::list && client.waiting.ticket == 0) {
        ask_next_of_list(client);
      }
    } else if (client.take_overlong()) {
      refuse(client, "line", "it is longer than 511 characters");
    } else if (const auto line = client.line()) {
      take(client, *line);
      client.drop_line();
    }
  }
  if (client.is_done() || (!client.has_sent() && !client.send(now_ns_))) {
    client.disconnect();
  }
}

void CommandServer::take(CommandClient& client, std::string_view line) {
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
  client.waiting = {.verb = command->verb, .request = command->request};
  carry_out(client, *command);
}

void CommandServer::carry_out(CommandClient& client, const CommandLine& command) {
  switch (command.verb) {
    case Verb::request:
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
      if (!config_.allow_inject) {
        refuse(client, "inject", "faults are not for sale here; start with --allow-inject");
        break;
      }
      client.waiting.injection = command.injection;
      ask(client, {.kind = CommandKind::inject, .injection = command.injection});
      break;
    case Verb::help:
      client.out().add(kHelp).end();
      break;
  }
}

void CommandServer::ask(CommandClient& client, Command command) {
  last_ticket_ = std::max<Ticket>(last_ticket_ + 1, 1);
  command.ticket = last_ticket_;
  client.waiting.ticket = command.ticket;
  client.waiting.is_under_way = true;
  client.waiting.deadline_ns = now_ns_ + kMostWait_ns;
  if (const auto known = desk_.post(command)) {
    deliver(*known);
  }
}

void CommandServer::ask_parameter(CommandClient& client, const CommandLine& command) {
  ParameterPlace place{.parameter = command.name.parameter};
  if (!command.name.object.empty()) {
    auto number = object_number(command.name.object);
    number = number ? number : scenes_.find_object(command.name.object);
    if (!number) {
      refuse(client, word_of(client.waiting), describe(ParameterRefusal::no_such_object));
      return;
    }
    place.object = *number;
  }
  client.waiting.place = place;
  ask(client, {.kind = command.verb == Verb::set ? CommandKind::set : CommandKind::get,
               .change = {.place = place, .value = command.value}});
}

// First for the mode: opening an image takes its time, in which nobody is heard, so it is not begun
// while there is power on the motors.
void CommandServer::ask_scene(CommandClient& client, std::string_view file) {
  std::ranges::copy(file, client.waiting.file.begin());
  client.waiting.is_asking = true;
  ask(client, {.kind = CommandKind::look});
}

void CommandServer::hand_scene_over(CommandClient& client, const Answer& answer) {
  client.waiting.is_asking = false;
  if (answer.after == Mode::active) {
    refuse(client, "scene", "the mode is active; send disable first");
    return;
  }
  if (scene_ticket_ != 0) {
    refuse(client, "scene", "another scene is on its way to the loop; send it again");
    return;
  }
  const auto opened = scenes_.open_next(client.waiting.file.data());
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
  ask(client, {.kind = CommandKind::scene, .scene = *opened});
  scene_ticket_ = client.waiting.ticket;
}

void CommandServer::ask_next_of_list(CommandClient& client) {
  const rendering::SceneImage* const scene = scenes_.scene();
  const auto place =
      listed_place(client.waiting.listed, scene == nullptr ? 0 : scene->objects().size());
  if (!place) {
    client.out().add("ok list").end();
    client.waiting.is_under_way = false;
    return;
  }
  ++client.waiting.listed;
  client.waiting.place = *place;
  ask(client, {.kind = CommandKind::get, .change = {.place = *place}});
}

void CommandServer::switch_recording(CommandClient& client, std::string_view file) {
  const RunHooks& hooks = config_.hooks;
  if (hooks.start_recording == nullptr || hooks.stop_recording == nullptr) {
    refuse(client, "record", "nothing here records");
    return;
  }
  const std::string_view wrong =
      file.empty() ? hooks.stop_recording(hooks.run) : hooks.start_recording(hooks.run, file);
  if (!wrong.empty()) {
    refuse(client, "record", wrong);
    return;
  }
  // The tick by which it took effect.
  ask(client, {.kind = CommandKind::look});
}

void CommandServer::refuse(CommandClient& client, std::string_view command, std::string_view why) {
  write_refusal(client.out(), command, why);
  client.waiting.is_under_way = false;
}

void CommandServer::give_up(CommandClient& client) {
  client.waiting.ticket = 0;
  refuse(client, word_of(client.waiting), "the loop has not answered for a second; see its log");
}

void CommandServer::deliver(const Answer& answer) {
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
                                waiting.request == Request::estop && is_stop;
    if (client.is_connected() && waiting.is_under_way && (for_it || waits_for_stop)) {
      client.waiting.ticket = 0;
      reply(client, answer);
    }
  }
}

// Whoever asked for it may have gone.
void CommandServer::take_over_scene(const Answer& answer) {
  if (answer.kind != CommandKind::scene || answer.ticket != scene_ticket_) {
    return;
  }
  scene_ticket_ = 0;
  if (answer.outcome != Outcome::done) {
    remember_refused_object(answer.scene_refusal);
    scenes_.drop_next();
    return;
  }
  if (config_.hooks.scene_changed != nullptr) {
    config_.hooks.scene_changed(config_.hooks.run, scenes_.next_bytes());
  }
  scenes_.use_next();
}

// Its name, which goes with the image.
void CommandServer::remember_refused_object(const SceneRefusal& refusal) {
  refused_object_.fill('\0');
  const bool is_object = refusal.fault == SceneFault::uncertified &&
                         refusal.part.kind == UncertifiedPart::Kind::object;
  if (const rendering::SceneImage* const next = scenes_.next_scene();
      is_object && next != nullptr) {
    const std::string_view name = next->object_name(refusal.part.index);
    std::ranges::copy(name.substr(0, refused_object_.size() - 1), refused_object_.begin());
  }
}

void CommandServer::reply(CommandClient& client, const Answer& answer) {
  TextLine& out = client.out();
  client.waiting.is_under_way = false;
  switch (client.waiting.verb) {
    case Verb::request:
      write_request_reply(out, answer);
      break;
    case Verb::set:
    case Verb::get:
      write_parameter_reply(out, word_of(client.waiting), client.waiting.place, answer);
      break;
    case Verb::list:
      reply_list(client, answer);
      break;
    case Verb::scene:
      reply_scene(client, answer);
      break;
    case Verb::inject:
      out.add("ok inject");
      write_tick(out, answer);
      out.add(" fault=").add(
          kInjectionTexts[static_cast<std::size_t>(client.waiting.injection.injection)].name);
      out.add(" ticks=").add(client.waiting.injection.ticks).end();
      break;
    default:
      reply_status(client, answer);
      break;
  }
}

void CommandServer::reply_scene(CommandClient& client, const Answer& answer) {
  if (client.waiting.is_asking) {
    client.waiting.is_under_way = true;
    hand_scene_over(client, answer);
    return;
  }
  if (answer.outcome == Outcome::scene) {
    std::array<char, kMaxCommandLine> room{};
    refuse(client, "scene", refusal_words(answer.scene_refusal, refused_object_.data(), room));
    return;
  }
  TextLine& out = client.out();
  out.add("ok scene");
  write_tick(out, answer);
  const rendering::SceneImage* const scene = scenes_.scene();
  out.add(" objects=").add(scene == nullptr ? 0 : scene->objects().size());
  out.add(" file=").add(scenes_.path()).end();
}

// Of `status` and `record`.
void CommandServer::reply_status(CommandClient& client, const Answer& answer) {
  TextLine& out = client.out();
  out.add("ok ").add(word_of(client.waiting));
  write_tick(out, answer);
  out.add(" faults=");
  write_faults(out, answer.faults);
  const std::string_view scene = scenes_.path();
  out.add(" scene=").add(scene.empty() ? "none" : scene).end();
}

void CommandServer::reply_list(CommandClient& client, const Answer& answer) {
  client.waiting.is_under_way = true;
  if (answer.outcome != Outcome::done) {
    return;
  }
  TextLine& out = client.out();
  const ParameterPlace& place = client.waiting.place;
  out.add("parameter");
  write_parameter(out, place, answer.value);
  if (const rendering::SceneImage* const scene = scenes_.scene();
      is_of_object(place.parameter) && scene != nullptr) {
    out.add(" object=").add(scene->object_name(place.object));
  }
  out.end();
}

}  // namespace tactus::firmware
