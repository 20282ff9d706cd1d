// A thread with a datagram socket for the emergency stop alone. Every datagram is an emergency
// stop, whatever it contains. No client can occupy the socket, and no file, list or other command
// delays it.
//
// The thread has the priority just below the loop's. It allocates nothing and waits only for a
// datagram and for the tick that takes the stop. It answers each sender that has an address.
#pragma once

#include <atomic>
#include <expected>

#include "firmware/commands/command_queue.h"
#include "firmware/linux/commands/listening_socket.h"
#include "firmware/linux/realtime/helper_thread.h"

namespace tactus::firmware {

// The socket and the thread of the stop.
struct StopListenerConfig {
  // The path of the datagram socket.
  const char* socket_path = nullptr;
  // The group of the socket's file; null: the program's own.
  const char* group = nullptr;
  // The SCHED_FIFO priority; the thread is an ordinary one if it is 0 or if the right to it is
  // missing.
  int priority = 0;
};

// The listener of one queue, which must outlive it. The thread that starts it also stops it.
class StopListener {
 public:
  explicit StopListener(CommandQueue& queue) : queue_(queue) {}
  StopListener(const StopListener&) = delete;
  StopListener& operator=(const StopListener&) = delete;
  ~StopListener() { stop(); }

  // Opens the socket and starts the thread. Errors are those of ListeningSocket::open_datagrams,
  // and that the system gives no thread.
  std::expected<void, ListenError> start(const StopListenerConfig& config);

  // Ends the thread, within 0.2 s, and removes the socket's file.
  void stop();

 private:
  // The thread's body.
  void run();
  // Posts a stop for each waiting datagram, waits for the tick and answers the senders.
  void hear_all();

  CommandQueue& queue_;
  ListeningSocket socket_;
  HelperThread thread_;
  int priority_ = 0;
  std::atomic<bool> is_ending_{false};
};

}  // namespace tactus::firmware
