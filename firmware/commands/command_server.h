// The command thread: takes lines from the command socket for the clerk, and sends its replies.
//
// Not real time: a thread of its own without priority. It allocates nothing after the start, and
// the loop never waits for it; a client that does not read its replies is dropped.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>

#include "firmware/commands/command_clerk.h"
#include "firmware/commands/command_client.h"
#include "firmware/commands/command_desk.h"
#include "firmware/commands/listening_socket.h"
#include "firmware/commands/scene_store.h"
#include "firmware/commands/stop_listener.h"
#include "firmware/realtime/helper_thread.h"

namespace tactus::firmware {

// Programs that are connected at once. The next one is told so and closed.
inline constexpr std::size_t kMaxCommandClients = 8;
// Between two times that the answers are taken, each says a request and raises an estop at most,
// and one request is in the tick.
static_assert(2 * kMaxCommandClients + 1 <= kMaxRequests);

struct CommandServerConfig {
  const char* socket_path = nullptr;
  const char* stop_socket_path = nullptr;  // of StopListener; null: there is none
  const char* group = nullptr;             // of the sockets' files; null: the program's
  int stop_priority = 0;                   // of the stop's thread: StopListenerConfig::priority
  bool allow_inject = false;
  RunHooks hooks;
};

class CommandServer {
 public:
  CommandServer(CommandDesk& desk, SceneStore& scenes)
      : stop_listener_(desk), clerk_(desk, scenes, clients_) {}
  CommandServer(const CommandServer&) = delete;
  CommandServer& operator=(const CommandServer&) = delete;
  ~CommandServer() { stop(); }

  // Opens the socket and starts the thread. Errors: of ListeningSocket::open, and that the system
  // gives no thread.
  std::expected<void, ListenError> start(const CommandServerConfig& config);

  // Ends the threads and removes the sockets' files. What was asked and has not been answered is
  // told that the program ends. False: the thread hangs in a file system that does not answer, and
  // is left alone after kMostEnd_ns; the program has to end without running destructors.
  bool stop();
  static constexpr hal::TimeNs kMostEnd_ns = hal::kNsPerSecond;

  [[nodiscard]] bool is_running() const { return is_running_; }

 private:
  void run();
  void turn();
  void wait();
  void welcome();
  CommandClient& place_for_one_more();
  void say_goodbye();

  void listen_to(CommandClient& client);
  void serve(CommandClient& client);

  StopListener stop_listener_;
  ListeningSocket socket_;
  std::array<CommandClient, kMaxCommandClients> clients_;
  CommandClerk clerk_;
  std::array<pollfd, kMaxCommandClients + 1> polled_{};
  hal::TimeNs now_ns_ = 0;
  HelperThread thread_;
  bool is_running_ = false;
  std::atomic<bool> is_ending_{false};
};

}  // namespace tactus::firmware
