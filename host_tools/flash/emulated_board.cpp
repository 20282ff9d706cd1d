#include "host_tools/flash/emulated_board.h"

#include <fmt/format.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <system_error>

#include "hal/linux/system.h"
#include "host_tools/flash/board_program.h"
#include "host_tools/flash/emulator_bridge.h"
#include "host_tools/input_error.h"
#include "host_tools/install_command.h"

namespace tactus::host {
namespace {

// The program and its package have one name.
constexpr const char* kEmulator = "qemu-system-arm";

void check_place(const EmulatedBoard& board) {
  constexpr std::size_t kLongestSocket = 107;
  if (find_tool(kEmulator).empty()) {
    throw InputError(fmt::format("{} is not installed: {}", kEmulator, install_command(kEmulator)));
  }
  if (board.line.empty() || board.line.size() > kLongestSocket) {
    throw InputError(fmt::format("--line '{}': a socket's path has 1 to {} characters", board.line,
                                 kLongestSocket));
  }
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(board.line, error))) {
    throw InputError(
        fmt::format("{}: it is there already: another emulator runs, or one has ended "
                    "badly; rm it, or give another --line",
                    board.line));
  }
}

}  // namespace

std::vector<std::string> emulator_command(const EmulatedBoard& board) {
  return {kEmulator,
          "-M",
          board.machine,
          "-display",
          "none",
          "-chardev",
          fmt::format("socket,id=monitor,fd={}", kMonitorDescriptor),
          "-mon",
          "chardev=monitor,mode=readline",
          "-serial",
          "stdio",
          "-icount",
          "shift=1,sleep=off",
          "-kernel",
          board.program};
}

bool run_emulated_board(const EmulatedBoard& board, const std::function<void()>& ready) {
  check_board_program(board.program);
  check_place(board);
  sigset_t signals;
  ::sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    ::sigaddset(&signals, signal);
  }
  const hal::SignalMask blocked(SIG_BLOCK, signals);
  const hal::FileDescriptor asked_to_end(::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK));
  EmulatorBridge bridge(board.line, emulator_command(board), signals);
  ready();
  while (bridge.turn(asked_to_end.get())) {
  }
  // A signal that stays pending would end this program when it is unblocked.
  signalfd_siginfo taken{};
  (void)!::read(asked_to_end.get(), &taken, sizeof taken);
  return bridge.is_asked_to_end();
}

}  // namespace tactus::host
