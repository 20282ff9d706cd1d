// Parses a line of the command socket: one command, its words separated by spaces. README.md has
// the table of commands.
//
// The functions do no I/O, use no heap and may be called from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string_view>

#include "firmware/control/mode.h"
#include "firmware/control/parameter_name.h"
#include "firmware/linux/commands/injection.h"

namespace tactus::firmware {

// The largest size of a line in bytes, with its newline. A longer line is skipped and refused.
inline constexpr std::size_t kMaxCommandLine = 512;

enum class Verb : std::uint8_t { request, set, get, list, status, scene, record, inject, help };

struct CommandLine {
  Verb verb = Verb::help;
  Request request = Request::none;  // used by `request`
  ParameterName name;               // used by `set` and `get`; views into the line
  double value = 0.0;               // used by `set`, in the parameter's unit; may be inf or NaN
  std::string_view file;            // used by `scene` and `record on`; empty for `record off`
  InjectionOrder injection;         // used by `inject`
};

// Returns the command, or a text that says what is wrong and what would be right. The result holds
// views into `line`.
std::expected<CommandLine, std::string_view> parse_command(std::string_view line);

// Returns the first word of the line, the name that a reply gives to the command.
std::string_view first_word(std::string_view line);

}  // namespace tactus::firmware
