// The command thread: takes lines from the command socket, hands them to the tick through the desk,
// and tells each who asked what the tick made of it.
//
// Not real time: a thread of its own without priority. It allocates nothing after the start, and
// the loop never waits for it; a client that does not read its replies is dropped.
#pragma once

#include <pthread.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "firmware/commands/command_client.h"
#include "firmware/commands/command_desk.h"
#include "firmware/commands/listening_socket.h"
#include "firmware/commands/scene_store.h"

namespace tactus::firmware {

// Programs that are connected at once. The next one is told so and closed.
inline constexpr std::size_t kMaxCommandClients = 8;
static_assert(kMaxCommandClients < kMaxWaiting);

// What else of the run a command reaches, each from the command thread; null: there is none.
struct RunHooks {
  void* run = nullptr;
  // Empty if it went well, or what is wrong and what to do.
  std::string_view (*start_recording)(void* run, std::string_view file) = nullptr;
  std::string_view (*stop_recording)(void* run) = nullptr;
  // The loop has taken another scene; when this returns, nobody may hold the one before.
  void (*scene_changed)(void* run, std::span<const std::byte> image) = nullptr;
};

struct CommandServerConfig {
  const char* socket_path = nullptr;
  const char* group = nullptr;  // of the socket's file; null: the program's
  bool allow_inject = false;
  RunHooks hooks;
};

class CommandServer {
 public:
  CommandServer(CommandDesk& desk, SceneStore& scenes) : desk_(desk), scenes_(scenes) {}
  CommandServer(const CommandServer&) = delete;
  CommandServer& operator=(const CommandServer&) = delete;
  ~CommandServer() { stop(); }

  // Opens the socket and starts the thread. Errors: of ListeningSocket::open, and that the system
  // gives no thread.
  std::expected<void, ListenError> start(const CommandServerConfig& config);

  // Ends the thread, within 0.1 s, and removes the socket's file. What was asked and has not been
  // answered is told that the program ends.
  void stop();

  [[nodiscard]] bool is_running() const { return is_running_; }

 private:
  static void* run_thread(void* server);
  void run();
  void turn();
  void wait();
  void welcome();
  CommandClient& place_for_one_more();
  void say_goodbye();

  void listen_to(CommandClient& client);
  void serve(CommandClient& client);
  void take(CommandClient& client, std::string_view line);
  void carry_out(CommandClient& client, const CommandLine& command);
  void ask(CommandClient& client, Command command);
  void ask_parameter(CommandClient& client, const CommandLine& command);
  void ask_scene(CommandClient& client, std::string_view file);
  void ask_next_of_list(CommandClient& client);
  void switch_recording(CommandClient& client, std::string_view file);
  void refuse(CommandClient& client, std::string_view command, std::string_view why);

  void deliver(const Answer& answer);
  void take_over_scene(const Answer& answer);
  void remember_refused_object(const SceneRefusal& refusal);
  void reply(CommandClient& client, const Answer& answer);
  void reply_scene(CommandClient& client, const Answer& answer);
  void reply_status(CommandClient& client, const Answer& answer);
  void reply_list(CommandClient& client, const Answer& answer);
  void hand_scene_over(CommandClient& client, const Answer& answer);
  void give_up(CommandClient& client);

  CommandDesk& desk_;
  SceneStore& scenes_;
  CommandServerConfig config_;
  ListeningSocket socket_;
  std::array<CommandClient, kMaxCommandClients> clients_;
  std::array<pollfd, kMaxCommandClients + 1> polled_{};
  hal::TimeNs now_ns_ = 0;
  Ticket last_ticket_ = 0;
  std::array<char, 64> refused_object_{};
  Ticket scene_ticket_ = 0;  // of the scene that the loop has not answered yet; 0: none
  pthread_t thread_{};
  bool is_running_ = false;
  std::atomic<bool> is_ending_{false};
};

}  // namespace tactus::firmware
