// Carries bytes between an emulator's standard input and output, which are the UART of its board,
// and the program that has connected to a Unix socket. One thread.
//
// The emulator could listen to the socket itself, but QEMU's UART stops for ever when its reader
// goes while the socket is full, and it sends byte by byte, which fills a socket soon.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <string>
#include <vector>

#include "hal/linux/system.h"
#include "host_tools/flash/emulator_pace.h"

namespace tactus::host {

// The descriptor at which the emulator finds the socket for its monitor.
inline constexpr int kMonitorDescriptor = 3;

class EmulatorBridge {
 public:
  // Listens to the socket `path`, whose file is removed at the end. The emulator is started by
  // `command` when the first program connects; it gets the blocked `signals` unblocked, and ends
  // with this process. Throws InputError if the socket cannot be made.
  EmulatorBridge(std::string path, std::vector<std::string> command, const sigset_t& signals);
  EmulatorBridge(const EmulatorBridge&) = delete;
  EmulatorBridge& operator=(const EmulatorBridge&) = delete;
  // Ends the emulator.
  ~EmulatorBridge();

  // Waits for something to carry, and carries it. Returns false when the emulator has ended, or
  // when `asked_to_end` can be read. Throws InputError if the system gives no process.
  bool turn(int asked_to_end);

  // Returns true if turn() returned false because the user asked for the end.
  [[nodiscard]] bool is_asked_to_end() const { return is_asked_to_end_; }

 private:
  // Bytes that have been read and not been written yet.
  struct Waiting {
    std::array<std::byte, 65536> room{};
    std::size_t begin = 0;
    std::size_t end = 0;

    [[nodiscard]] bool is_empty() const { return begin == end; }
    // Reads bytes if none wait. Returns false if the other end is gone.
    bool read_from(int descriptor);
    // Writes what waits. Returns false if the other end is gone.
    bool write_to(int descriptor);
  };

  void start_emulator();
  void accept_program();
  // Carry bytes one way.
  void to_board();
  // Returns false if the emulator has ended.
  bool from_board();
  void let_program_go();

  std::string path_;
  std::vector<std::string> command_;
  sigset_t signals_;
  hal::FileDescriptor socket_;
  hal::FileDescriptor program_;
  hal::FileDescriptor to_board_;
  hal::FileDescriptor from_board_;
  EmulatorPace pace_;
  pid_t emulator_ = 0;
  bool is_asked_to_end_ = false;
  Waiting for_board_;
  Waiting for_program_;
};

}  // namespace tactus::host
