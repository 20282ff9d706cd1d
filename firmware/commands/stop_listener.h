// The stop, heard whatever else is asked: a thread and a datagram socket of its own. Whatever
// arrives there is an emergency stop. No client can occupy it, and no file, list or other command
// stands before it.
//
// The thread has the priority below the loop's. It allocates nothing and waits for nothing but a
// datagram and the tick that has the stop. It answers each sender that has an address.
#pragma once

#include <atomic>
#include <expected>

#include "firmware/commands/command_desk.h"
#include "firmware/commands/listening_socket.h"
#include "firmware/realtime/helper_thread.h"

namespace tactus::firmware {

struct StopListenerConfig {
  const char* socket_path = nullptr;
  const char* group = nullptr;  // of the socket's file; null: the program's
  int priority = 0;             // SCHED_FIFO of the thread; 0, or without the right to it: ordinary
};

class StopListener {
 public:
  explicit StopListener(CommandDesk& desk) : desk_(desk) {}
  StopListener(const StopListener&) = delete;
  StopListener& operator=(const StopListener&) = delete;
  ~StopListener() { stop(); }

  // Opens the socket and starts the thread. Errors: of ListeningSocket::open_datagrams, and that
  // the system gives no thread.
  std::expected<void, ListenError> start(const StopListenerConfig& config);

  // Ends the thread, within 0.2 s, and removes the socket's file.
  void stop();

 private:
  void run();
  void hear_all();

  CommandDesk& desk_;
  ListeningSocket socket_;
  HelperThread thread_;
  int priority_ = 0;
  std::atomic<bool> is_ending_{false};
};

}  // namespace tactus::firmware
