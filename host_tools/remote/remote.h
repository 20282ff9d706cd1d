// A running controller, reached through its command socket: one line there, its reply back.
//
// The lines and replies are in firmware/linux/commands/README.md. Blocking; one thread.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/linux/system.h"

namespace tactus::host {

inline constexpr std::string_view kDefaultRunDir = "/run/tactus";
inline constexpr std::string_view kCommandSocket = "command.sock";
inline constexpr std::string_view kStopSocket = "stop.sock";

// Nobody could be asked; the text names the socket and the remedy.
class UnreachableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Reply {
  bool is_ok = false;
  std::string text;                // "ok enable tick=7 mode=active", without its newline
  std::vector<std::string> lines;  // those before it, of `list`
};

// The value of "name=value" in a line; nothing if it is not there.
std::optional<std::string> field_of(std::string_view line, std::string_view name);

class Remote {
 public:
  // Throws UnreachableError.
  explicit Remote(const std::filesystem::path& run_dir);

  // Throws UnreachableError if no reply comes within the time: the controller itself answers or
  // refuses within one second. `line` has no newline.
  Reply send(const std::string& line,
             std::chrono::milliseconds patience = std::chrono::milliseconds(5000));

 private:
  std::string receive_line(std::chrono::steady_clock::time_point deadline);
  [[noreturn]] void lost(std::string_view why) const;

  std::string path_;
  hal::FileDescriptor socket_;
  std::string received_;
};

// The emergency stop, by the socket that no other command can delay. The reply says which tick had
// it. Throws UnreachableError, also where no reply comes within the time.
Reply send_stop(const std::filesystem::path& run_dir,
                std::chrono::milliseconds patience = std::chrono::milliseconds(1000));

}  // namespace tactus::host
