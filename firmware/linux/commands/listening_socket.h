// A Unix socket, for streams or datagrams, with a file in the file system. The file has mode 0660
// and the given group. Whoever may write to the file may connect.
//
// Not real time: it is for the start of the program. One thread at a time.
#pragma once

#include <array>
#include <expected>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::firmware {

// Why a socket was not opened.
struct ListenError {
  // The text for the user: what went wrong and what to do.
  std::string_view what;
  // The errno of the call that failed.
  int errno_value = 0;
};

// One socket. The destructor closes it and removes its file.
class ListeningSocket {
 public:
  ListeningSocket() = default;
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  ~ListeningSocket() { close(); }

  // Opens a stream socket. A null or empty `group` leaves the file to the program's group. A file
  // on which no program listens any more is replaced. Call it before other threads start, because
  // it changes the process's file mode mask for a moment.
  std::expected<void, ListenError> open(const char* path, const char* group);
  // Opens a datagram socket; otherwise the same.
  std::expected<void, ListenError> open_datagrams(const char* path, const char* group);
  // Closes the socket and removes its file.
  void close();
  // Removes the file and leaves the socket open, because another thread may still use it.
  void remove_file();

  // Returns the descriptor to wait for; -1 if it is not open.
  [[nodiscard]] int descriptor() const { return socket_.get(); }

  // Returns the non-blocking socket of a program that has connected; it is not open if none has.
  // Never waits.
  [[nodiscard]] hal::FileDescriptor accept() const;

 private:
  std::expected<void, ListenError> open(const char* path, const char* group, int type);
  std::expected<void, ListenError> bind_and_listen(const char* group, int type);

  hal::FileDescriptor socket_;
  // The path of the file; empty without one. It has the size of sockaddr_un::sun_path.
  std::array<char, 108> path_{};
};

}  // namespace tactus::firmware
