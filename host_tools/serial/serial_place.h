// The place of a line to a board as the user writes it, and the words of the errors when it cannot
// be opened. Host tools, any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace tactus::host {

// The rate without one from the user, bit/s. It is the highest that the usual USB adapters and the
// UARTs of most microcontrollers both make exactly; a board with its own USB ignores the rate.
inline constexpr std::uint32_t kDefaultBaud = 1'000'000;
// The prefix of a Unix socket, such as an emulator's.
inline constexpr std::string_view kSocketPrefix = "unix:";

// A tty with its rate, or a Unix socket.
struct SerialPlace {
  std::string path;
  std::uint32_t baud = kDefaultBaud;
  bool is_socket = false;
};

// Returns the place that PATH, PATH:BAUD or unix:PATH names. A number after the last colon is the
// rate, unless there is a file of the whole name. Throws InputError if the path is empty or the
// rate is out of range.
SerialPlace parse_serial_place(const std::string& text);

// Returns a sentence about the serial ports that there are. `folder` has a link for each.
std::string port_words(const std::filesystem::path& folder = "/dev/serial/by-id");

// The program that holds a file open.
struct FileHolder {
  std::string program;
  int process = 0;
};

// Returns another program that holds the file open, or nothing if none is known: those of other
// users are visible to root alone.
std::optional<FileHolder> holder_of(const std::filesystem::path& file);

// Returns why a place cannot be opened, and what to do, for an errno of the call that failed.
std::string serial_remedy(const SerialPlace& place, int errno_value);

}  // namespace tactus::host
