// A pair of pseudo-terminals: the host's end opens like any tty, the board's end is a descriptor.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>

#include "hal/linux/system.h"

namespace tactus::host {

class PseudoTerminal {
 public:
  PseudoTerminal() : board_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    ::grantpt(board_.get());
    ::unlockpt(board_.get());
    std::array<char, 64> name{};
    ::ptsname_r(board_.get(), name.data(), name.size());
    path_ = name.data();
  }

  // Returns the path of the host's end.
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] int board() const { return board_.get(); }
  // Hangs the line up, as a pulled cable does.
  void hang_up() { board_.reset(); }

 private:
  hal::FileDescriptor board_;
  std::string path_;
};

}  // namespace tactus::host
