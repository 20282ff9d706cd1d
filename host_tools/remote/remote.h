// A client of a running controller: it sends one command line through the command socket of tactusd
// or `tactus sim --serve` and receives the reply. The verbs of `tactus` and the monitor use it, in
// their own process and one thread; every call blocks until its reply or its time limit. The lines
// and replies are described in firmware/linux/commands/README.md.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/linux/system.h"

namespace tactus::host {

// The folder in which tactusd puts its sockets unless --run-dir or TACTUS_RUN_DIR names another,
// and the sockets in it.
inline constexpr std::string_view kDefaultRunDir = "/run/tactus";
inline constexpr std::string_view kCommandSocket = "command.sock";
inline constexpr std::string_view kStopSocket = "stop.sock";
// The folder in it with a symbolic link for the name of each device.
inline constexpr std::string_view kNamesFolder = "by-name";

// Returns the folder of the sockets of a controller's device, 1 for the first. `run_dir` is the
// controller's folder.
std::filesystem::path run_folder_of(const std::filesystem::path& run_dir, std::size_t device);

// Thrown if no controller could be asked or none replied. The text names the socket and the remedy.
class UnreachableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Returns the folder of the sockets of the device of that name, or of that number, 1 for the first.
// Throws UnreachableError, which names the devices that there are, if none has the name.
std::filesystem::path run_folder_of(const std::filesystem::path& run_dir,
                                    const std::string& device);

// The controller's answer to one line.
struct Reply {
  // True if the controller did what the line asks; false if it refused.
  bool is_ok = false;
  // The last line of the reply without its newline, like "ok enable tick=7 mode=active". A refusal
  // gives the reason and the remedy.
  std::string text;
  // The lines before the last one; only `list` has any.
  std::vector<std::string> lines;
};

// A connection to one controller's command socket.
class Remote {
 public:
  // Connects to the command socket in `run_dir`. Throws UnreachableError if no controller listens
  // there or this user may not reach it.
  explicit Remote(const std::filesystem::path& run_dir);

  // Sends one line, which has no newline, and waits for its reply. Throws UnreachableError if none
  // comes within `patience`, or the controller has ended. The controller itself answers or refuses
  // within one second, so a longer wait means an overloaded machine.
  Reply send(const std::string& line,
             std::chrono::milliseconds patience = std::chrono::milliseconds(5000));

 private:
  std::string receive_line(std::chrono::steady_clock::time_point deadline);
  [[noreturn]] void lost(std::string_view why) const;

  std::string path_;
  hal::FileDescriptor socket_;
  std::string received_;
};

// Sends the emergency stop through its own socket, where no other command can delay it. The reply
// says in which tick the controller took it. Throws UnreachableError if the socket cannot be
// reached or no reply comes within `patience`: the user must then cut the power of the motors.
Reply send_stop(const std::filesystem::path& run_dir,
                std::chrono::milliseconds patience = std::chrono::milliseconds(1000));

}  // namespace tactus::host
