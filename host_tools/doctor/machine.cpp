#include "host_tools/doctor/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "host_tools/benchmark/unit_cost.h"
#include "host_tools/doctor/live_machine.h"
#include "host_tools/input_error.h"

namespace tactus::host {

namespace {

// The files of a recorded machine for what no file of /proc or /sys tells: a line for each.
constexpr const char* kAccessFile = "tactus/access";
constexpr const char* kGpioFile = "tactus/gpio_chips";
constexpr const char* kInterruptFile = "tactus/interrupt_delays";
constexpr const char* kUnitCostFile = "tactus/unit_cost_ns";

// Returns the text without blanks and line ends at its end.
std::string without_end(std::string text) {
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  return text;
}

// Files of /proc and /sys have no size, so the stream is read to its end.
std::optional<std::string> read_bytes(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return std::nullopt;
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return std::nullopt;
  }
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

// Returns the text of a file without blanks and line ends at its end.
std::optional<std::string> read_whole(const std::filesystem::path& path) {
  return read_bytes(path).transform(without_end);
}

// Returns the path below the root of the tree.
std::filesystem::path below(const std::filesystem::path& root, std::string_view path) {
  return root / std::filesystem::path(path).relative_path();
}

std::string ip_file(std::string_view interface) {
  return fmt::format("tactus/ip_link_{}.json", interface);
}

// Writes a file and the folders above it. Throws InputError if it cannot be written.
void write_whole(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  if (!(file << text << '\n' << std::flush)) {
    throw InputError(path.string() + ": cannot be written; check the folder and its permissions");
  }
}

}  // namespace

Machine::Machine(std::filesystem::path root) : root_(std::move(root)) {
  if (!std::filesystem::is_directory(root_ / "proc")) {
    throw InputError(root_.string() +
                     ": no recorded machine, which would have a folder proc; make one with "
                     "tactus doctor --save");
  }
}

std::optional<std::string> Machine::text(std::string_view path) {
  if (!root_.empty()) {
    return read_whole(below(root_, path));
  }
  auto found = read_whole(path);
  if (found) {
    files_.insert_or_assign(std::string(path), *found);
  }
  return found;
}

std::vector<std::string> Machine::names(std::string_view folder) {
  const std::filesystem::path where =
      root_.empty() ? std::filesystem::path(folder) : below(root_, folder);
  std::vector<std::string> found;
  std::error_code failed;
  for (std::filesystem::directory_iterator entry(where, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    found.push_back(entry->path().filename().string());
    if (root_.empty()) {
      folders_.push_back(entry->path().string());
    }
  }
  std::ranges::sort(found);
  return found;
}

std::optional<std::string> Machine::recorded_line(const char* file, std::string_view key,
                                                  bool key_first) const {
  std::istringstream lines(read_whole(root_ / file).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = std::min(line.find(' '), line.size());
    std::string first = line.substr(0, blank);
    std::string rest = line.substr(std::min(blank + 1, line.size()));
    if ((key_first ? first : rest) == key) {
      return key_first ? rest : first;
    }
  }
  return std::nullopt;
}

std::optional<bool> Machine::writable(std::string_view path) {
  if (!root_.empty()) {
    const auto letter = recorded_line(kAccessFile, path, false);
    return letter ? std::optional(*letter == "w") : std::nullopt;
  }
  const auto found = live_writable(path);
  if (found) {
    writable_.insert_or_assign(std::string(path), *found);
  }
  return found;
}

std::optional<std::string> Machine::gpio_label(std::string_view chip) {
  if (!root_.empty()) {
    return recorded_line(kGpioFile, chip, true);
  }
  auto found = live_gpio_label(chip);
  if (found) {
    gpio_labels_.insert_or_assign(std::string(chip), *found);
  }
  return found;
}

std::optional<std::string> Machine::ip_link(std::string_view interface) {
  if (!root_.empty()) {
    return read_whole(root_ / ip_file(interface));
  }
  // It takes a program to ask, and two checks do.
  if (const auto known = files_.find(ip_file(interface)); known != files_.end()) {
    return known->second;
  }
  auto found = live_ip_link(interface);
  if (found) {
    files_.insert_or_assign(ip_file(interface), *found);
  }
  return found;
}

std::optional<InterruptDelay> Machine::interrupt_delay(std::string_view interface) {
  if (!root_.empty()) {
    std::istringstream numbers(recorded_line(kInterruptFile, interface, true).value_or(""));
    InterruptDelay delay;
    return numbers >> delay.microseconds >> delay.frames ? std::optional(delay) : std::nullopt;
  }
  const auto found = live_interrupt_delay(interface);
  if (found) {
    interrupt_delays_.insert_or_assign(std::string(interface), *found);
  }
  return found;
}

std::optional<std::uint32_t> Machine::device_tree_number(std::string_view path) {
  constexpr std::size_t kBytes = 4;
  auto bytes = read_bytes(root_.empty() ? std::filesystem::path(path) : below(root_, path));
  if (!bytes || bytes->size() < kBytes) {
    return std::nullopt;
  }
  bytes->resize(kBytes);
  std::uint32_t number = 0;
  for (const char byte : *bytes) {
    number = number << 8U | static_cast<unsigned char>(byte);
  }
  if (root_.empty()) {
    files_.insert_or_assign(std::string(path), *std::move(bytes));
  }
  return number;
}

std::optional<double> Machine::unit_cost_ns() {
  if (!root_.empty()) {
    double cost_ns = 0.0;
    std::istringstream text(read_whole(root_ / kUnitCostFile).value_or(""));
    return text >> cost_ns ? std::optional(cost_ns) : std::nullopt;
  }
  const double cost_ns = measured_unit_cost_ns();
  files_.insert_or_assign(kUnitCostFile, fmt::format("{:.2f}", cost_ns));
  return cost_ns;
}

void Machine::save(const std::filesystem::path& folder) const {
  try {
    for (const std::string& path : folders_) {
      if (std::filesystem::is_directory(path)) {
        std::filesystem::create_directories(below(folder, path));
      } else if (!files_.contains(path)) {
        write_whole(below(folder, path), "");
      }
    }
    for (const auto& [path, text] : files_) {
      write_whole(below(folder, path), text);
    }
    std::string lines;
    for (const auto& [path, writable] : writable_) {
      lines += fmt::format("{} {}\n", writable ? 'w' : '-', path);
    }
    write_whole(folder / kAccessFile, without_end(lines));
    lines.clear();
    for (const auto& [chip, label] : gpio_labels_) {
      lines += fmt::format("{} {}\n", chip, label);
    }
    write_whole(folder / kGpioFile, without_end(lines));
    lines.clear();
    for (const auto& [interface, delay] : interrupt_delays_) {
      lines += fmt::format("{} {} {}\n", interface, delay.microseconds, delay.frames);
    }
    write_whole(folder / kInterruptFile, without_end(lines));
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError(fmt::format("{}: cannot be written: {}; check the folder and its permissions",
                                 folder.string(), error.code().message()));
  }
}

}  // namespace tactus::host
