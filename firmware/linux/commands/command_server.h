// The command thread: receives lines on the command socket, gives them to the CommandProcessor and
// sends the replies.
//
// The thread has no real-time priority. It allocates nothing after the start, and the loop never
// waits for it. A client that does not read its replies is disconnected.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>

#include "firmware/commands/command_queue.h"
#include "firmware/linux/commands/command_client.h"
#include "firmware/linux/commands/command_processor.h"
#include "firmware/linux/commands/listening_socket.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/commands/stop_listener.h"
#include "firmware/linux/realtime/helper_thread.h"

namespace tactus::firmware {

// The largest number of programs connected at once. One more takes the place of the program that
// has been silent longest.
inline constexpr std::size_t kMaxCommandClients = 8;
// Between two times at which the answers are taken, each client posts at most one request and one
// estop, and the tick holds one request more.
static_assert(2 * kMaxCommandClients + 1 <= kMaxRequests);

// The sockets and the parts of the program that commands reach.
struct CommandServerConfig {
  // The path of the command socket.
  const char* socket_path = nullptr;
  // The path of StopListener's socket; null: no such socket.
  const char* stop_socket_path = nullptr;
  // The group of the socket files; null: the program's own.
  const char* group = nullptr;
  // The priority of the stop's thread (stop_listener.h).
  int stop_priority = 0;
  // True: `inject` commands are accepted.
  bool allow_inject = false;
  RunHooks hooks;
};

// The server of one program. The thread that starts it also stops it.
class CommandServer {
 public:
  // `scenes` is null for a device that is not the controller's first one.
  CommandServer(CommandQueue& queue, SceneStore* scenes)
      : stop_listener_(queue), processor_(queue, scenes, clients_) {}
  CommandServer(const CommandServer&) = delete;
  CommandServer& operator=(const CommandServer&) = delete;
  ~CommandServer() { stop(); }

  // Opens the sockets and starts the threads. Errors are those of ListeningSocket::open, and that
  // the system gives no thread.
  std::expected<void, ListenError> start(const CommandServerConfig& config);

  // Ends the threads and removes the socket files. Commands without an answer are refused because
  // the program ends. Returns false if after kMostEnd_ns the thread still hangs in a file system
  // that does not answer: the program must then end without running destructors.
  bool stop();
  // The longest time that stop() waits for the thread.
  static constexpr hal::TimeNs kMostEnd_ns = hal::kNsPerSecond;

 private:
  // The thread's body: turns until stop().
  void run();
  // One turn: waits, hears the clients, delivers answers, serves the clients, accepts one more.
  void turn();
  // Waits until a socket is ready or it is time to look for answers.
  void wait();
  // Accepts a program that has connected.
  void welcome();
  // Returns a free place, or makes one.
  CommandClient& place_for_one_more();
  // Refuses what waits, because the program ends.
  void say_goodbye();

  // Receives a client's lines.
  void listen_to(CommandClient& client);
  // Carries out a client's next line, or goes on with the present one, and sends its reply.
  void serve(CommandClient& client);

  StopListener stop_listener_;
  ListeningSocket socket_;
  std::array<CommandClient, kMaxCommandClients> clients_;
  CommandProcessor processor_;
  std::array<pollfd, kMaxCommandClients + 1> polled_{};
  hal::TimeNs now_ns_ = 0;
  HelperThread thread_;
  bool is_running_ = false;
  std::atomic<bool> is_ending_{false};
};

}  // namespace tactus::firmware
