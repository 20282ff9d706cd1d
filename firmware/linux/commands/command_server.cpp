#include "firmware/linux/commands/command_server.h"

#include <poll.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace tactus::firmware {
namespace {

// The thread looks for answers at the first interval while a client waits for a tick, and otherwise
// for the end of the program at the second.
constexpr hal::TimeNs kLookForAnswer_ns = 1'000'000;
constexpr hal::TimeNs kLookForEnd_ns = 100'000'000;
// The stack must hold several checked scenes of half a megabyte, which are returned by value.
constexpr std::size_t kThreadStack_bytes = std::size_t{4} << 20;
static_assert(sizeof(rendering::SceneImage) < kThreadStack_bytes / 6);

bool is_estop(std::string_view line) {
  const auto command = parse_command(line);
  return command && command->request == Request::estop;
}

}  // namespace

std::expected<void, ListenError> CommandServer::start(const CommandServerConfig& config) {
  processor_.configure(config.hooks, config.allow_inject);
  if (auto open = socket_.open(config.socket_path, config.group); !open) {
    return open;
  }
  if (config.stop_socket_path != nullptr) {
    const StopListenerConfig stop{.socket_path = config.stop_socket_path,
                                  .group = config.group,
                                  .priority = config.stop_priority};
    if (auto started = stop_listener_.start(stop); !started) {
      socket_.close();
      return started;
    }
  }
  const int error = thread_.start(
      "tactus-commands", [](void* server) { static_cast<CommandServer*>(server)->run(); }, this,
      kThreadStack_bytes);
  if (error != 0) {
    stop_listener_.stop();
    socket_.close();
    return std::unexpected(ListenError{.what = "the system gives no thread", .errno_value = error});
  }
  is_running_ = true;
  return {};
}

bool CommandServer::stop() {
  if (!is_running_) {
    return true;
  }
  stop_listener_.stop();
  is_ending_.store(true, std::memory_order_relaxed);
  const bool has_ended = thread_.join_within(kMostEnd_ns);
  is_running_ = false;
  if (has_ended) {
    is_ending_.store(false, std::memory_order_relaxed);
    socket_.close();
  } else {
    socket_.remove_file();  // the thread may still use the socket
  }
  return has_ended;
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
  processor_.set_time(now_ns_);
  for (CommandClient& client : clients_) {
    listen_to(client);
  }
  processor_.deliver_answers();
  for (CommandClient& client : clients_) {
    if (client.is_connected()) {
      serve(client);
    }
  }
  if ((polled_.back().revents & POLLIN) != 0) {
    welcome();
  }
}

// Waits until a socket is ready or it is time to look for answers.
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

// Returns a free client, after disconnecting the one that has been silent longest if all are in
// use. So a program that sends an estop can always connect.
CommandClient& CommandServer::place_for_one_more() {
  const auto heard = [](const CommandClient& client) {
    return client.is_connected() ? client.last_heard_ns : hal::TimeNs{0};
  };
  CommandClient& client = *std::ranges::min_element(clients_, {}, heard);
  if (client.is_connected() && client.has_sent()) {
    processor_.refuse(client, "connection", "another program needed the place; connect again");
    client.send(now_ns_);
  }
  return client;
}

void CommandServer::say_goodbye() {
  for (CommandClient& client : clients_) {
    if (client.is_connected() && client.waiting.is_under_way && client.has_sent()) {
      processor_.refuse_waiting(client, "the program ends");
      client.send(now_ns_);
    }
    client.disconnect();
  }
}

// Receives lines. An estop among them is posted at once, even if its client still waits for the
// answer to another command.
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
      processor_.raise_estop();
      return;
    }
    rest.remove_prefix(end + 1);
  }
}

void CommandServer::serve(CommandClient& client) {
  processor_.look_after(client);
  if (client.has_sent() && !client.waiting.is_under_way) {
    if (client.take_overlong()) {
      processor_.refuse(client, "line", "it is longer than 511 characters");
    } else if (const auto line = client.line()) {
      processor_.take(client, *line);
      client.drop_line();
    }
  }
  // A program that has closed its side still gets the reply to its last line.
  if (client.is_done() || (!client.has_sent() && !client.send(now_ns_))) {
    client.disconnect();
  }
}

}  // namespace tactus::firmware
