#include "host_tools/doctor/process_status.h"

#include <charconv>
#include <limits>
#include <sstream>

namespace tactus::host {

namespace {

// Returns the number that the text begins with; nothing if it begins with something else.
std::optional<std::uint64_t> leading_number(std::string_view text, int base = 10) {
  std::uint64_t number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  return failed == std::errc{} ? std::optional(number) : std::nullopt;
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

// Returns the rest of the file's line that begins with `name`.
std::optional<std::string> line_of(Machine& machine, const char* path, std::string_view name) {
  std::istringstream lines(machine.text(path).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(name)) {
      return std::string(without_blanks(std::string_view(line).substr(name.size())));
    }
  }
  return std::nullopt;
}

std::optional<std::string> status_line(Machine& machine, std::string_view name) {
  return line_of(machine, "/proc/self/status", name);
}

}  // namespace

std::optional<std::uint64_t> soft_limit(Machine& machine, std::string_view name) {
  const auto line = line_of(machine, "/proc/self/limits", name);
  if (line && line->starts_with("unlimited")) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  return line ? leading_number(*line) : std::nullopt;
}

bool has_capability(Machine& machine, unsigned capability) {
  const auto effective = status_line(machine, "CapEff:");
  return effective && (leading_number(*effective, 16).value_or(0) >> capability & 1U) != 0;
}

// The line holds the real, effective, saved and file system user, in this order.
bool is_root(Machine& machine) {
  std::istringstream numbers(status_line(machine, "Uid:").value_or(""));
  std::string real;
  std::string effective;
  numbers >> real >> effective;
  return effective == "0";
}

std::vector<std::string> group_numbers(Machine& machine) {
  std::istringstream numbers(status_line(machine, "Gid:").value_or("") + " " +
                             status_line(machine, "Groups:").value_or(""));
  std::vector<std::string> groups;
  for (std::string number; numbers >> number;) {
    groups.push_back(number);
  }
  return groups;
}

std::optional<GroupEntry> group_entry(Machine& machine, std::string_view name) {
  const auto line = line_of(machine, "/etc/group", std::string(name) + ":");
  if (!line) {
    return std::nullopt;
  }
  // password:number:members
  const std::size_t number = line->find(':') + 1;
  const std::size_t members = line->find(':', number);
  if (number == 0 || members == std::string::npos) {
    return std::nullopt;
  }
  return GroupEntry{line->substr(number, members - number), line->substr(members + 1)};
}

}  // namespace tactus::host
