#include "host_tools/serial/serial_place.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The rates that any UART makes, bit/s.
constexpr std::uint32_t kLowestBaud = 1200;
constexpr std::uint32_t kHighestBaud = 12'000'000;

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// Throws InputError if it is out of range.
std::uint32_t parse_baud(const std::string& place, std::string_view text) {
  std::uint32_t baud = 0;
  const auto [end, error] = std::from_chars(text.begin(), text.end(), baud);
  if (error != std::errc{} || end != text.end() || baud < kLowestBaud || baud > kHighestBaud) {
    throw InputError(fmt::format("{}: a rate is from {} to {} bit/s, such as {}:{}", place,
                                 kLowestBaud, kHighestBaud,
                                 place.substr(0, place.size() - text.size() - 1), kDefaultBaud));
  }
  return baud;
}

// Returns the name of the group that may use the file.
std::string group_of_file(const std::string& path) {
  struct stat status{};
  const struct group* const group =
      ::stat(path.c_str(), &status) == 0 ? ::getgrgid(status.st_gid) : nullptr;
  return group == nullptr ? "dialout" : std::string(group->gr_name);
}

// Returns true if a process holds the file open under this name.
bool holds(const std::filesystem::path& process, const std::filesystem::path& file) {
  std::error_code error;
  for (std::filesystem::directory_iterator files(process / "fd", error), end;
       !error && files != end; files.increment(error)) {
    std::error_code unread;
    if (std::filesystem::read_symlink(files->path(), unread) == file && !unread) {
      return true;
    }
  }
  return false;
}

std::string busy_words(const std::string& path) {
  const auto holder = holder_of(path);
  if (!holder) {
    return fmt::format("another program holds it; sudo fuser {} names it", path);
  }
  return fmt::format("{} (process {}) holds it; end that program first{}", holder->program,
                     holder->process,
                     holder->program == "tactus" ? ", or if it is tactus line, give its --run-dir "
                                                   "in place of --serial"
                                                 : "");
}

}  // namespace

SerialPlace parse_serial_place(const std::string& text) {
  SerialPlace place{.path = text};
  std::error_code error;
  const std::size_t colon = text.rfind(':');
  if (text.starts_with(kSocketPrefix)) {
    place.path = text.substr(kSocketPrefix.size());
    place.is_socket = true;
  } else if (colon != std::string::npos && is_number(std::string_view(text).substr(colon + 1)) &&
             !std::filesystem::exists(text, error)) {
    place.path = text.substr(0, colon);
    place.baud = parse_baud(text, std::string_view(text).substr(colon + 1));
  }
  if (place.path.empty()) {
    throw InputError(
        fmt::format("'{}' names no serial port: give its path, such as /dev/ttyACM0 "
                    "or /dev/ttyUSB0:115200",
                    text));
  }
  return place;
}

std::string port_words(const std::filesystem::path& folder) {
  std::vector<std::string> ports;
  std::error_code error;
  for (std::filesystem::directory_iterator files(folder, error), end; !error && files != end;
       files.increment(error)) {
    ports.push_back(files->path().string());
  }
  std::ranges::sort(ports);
  return ports.empty() ? "no USB serial port is connected; is the cable one for data?"
                       : fmt::format("there are {}", fmt::join(ports, ", "));
}

std::optional<FileHolder> holder_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path name = std::filesystem::canonical(file, error);
  if (error) {
    return std::nullopt;
  }
  const std::string self = std::to_string(::getpid());
  for (std::filesystem::directory_iterator processes("/proc", error), end;
       !error && processes != end; processes.increment(error)) {
    const std::filesystem::path& process = processes->path();
    const std::string number = process.filename().string();
    if (is_number(number) && number != self && holds(process, name)) {
      std::string program;
      std::getline(std::ifstream(process / "comm"), program);
      return FileHolder{.program = program, .process = std::stoi(number)};
    }
  }
  return std::nullopt;
}

std::string serial_remedy(const SerialPlace& place, int errno_value) {
  switch (errno_value) {
    case ENOENT:
    case ENXIO:
    case ENODEV:
      return place.is_socket ? "no emulator runs there; start tactus flash --emulate"
                             : "there is no such port; " + port_words();
    case ECONNREFUSED:
      return "the emulator that listened there has ended; start tactus flash --emulate again";
    case EACCES:
    case EPERM:
      return fmt::format(
          "it is for the group {0}; join it with: sudo usermod -aG {0} $USER, and "
          "log in again",
          group_of_file(place.path));
    case EBUSY:
    case EWOULDBLOCK:
      return busy_words(place.path);
    case ENOTTY:
      return "it is no serial port; " + port_words();
    case EINVAL:
      return fmt::format("it cannot do {} bit/s; give another rate, as {}:115200", place.baud,
                         place.path);
    default:
      return std::strerror(errno_value);
  }
}

}  // namespace tactus::host
