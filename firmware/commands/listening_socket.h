// A Unix socket, of streams or datagrams, in the file system, with file permissions as its door:
// mode 0660, and a group if one is named. Whoever may write to the file may connect.
//
// At the start; not for a tick.
#pragma once

#include <array>
#include <expected>
#include <string_view>

#include "hal/linux/system.h"

namespace tactus::firmware {

// What went wrong, with what to do about it.
struct ListenError {
  std::string_view what;
  int errno_value = 0;
};

// Removes its file at the end.
class ListeningSocket {
 public:
  ListeningSocket() = default;
  ListeningSocket(const ListeningSocket&) = delete;
  ListeningSocket& operator=(const ListeningSocket&) = delete;
  ~ListeningSocket() { close(); }

  // `group` nullptr or empty leaves the group of the program. A file that nobody listens behind any
  // more is replaced. Only before other threads are started: it sets the file mode mask meanwhile.
  std::expected<void, ListenError> open(const char* path, const char* group);
  // The same, for datagrams: nobody connects.
  std::expected<void, ListenError> open_datagrams(const char* path, const char* group);
  void close();
  // Closes nothing: another thread may still use the descriptor.
  void remove_file();

  [[nodiscard]] int descriptor() const { return socket_.get(); }

  // A program that has connected, not blocking; not open if there is none.
  [[nodiscard]] hal::FileDescriptor accept() const;

 private:
  std::expected<void, ListenError> open(const char* path, const char* group, int type);
  std::expected<void, ListenError> bind_and_listen(const char* group, int type);

  hal::FileDescriptor socket_;
  std::array<char, 108> path_{};  // as long as a socket's address may be
};

}  // namespace tactus::firmware
