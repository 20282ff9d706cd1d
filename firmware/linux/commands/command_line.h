// Parses a line of the command socket: one command, its words separated by spaces. README.md has
// the table of commands.
//
// The functions do no I/O, use no heap and may be called from any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string_view>

#include "firmware/commands/injection.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameter_name.h"

namespace tactus::firmware {

// The largest size of a line in bytes, with its newline. A longer line is skipped and refused.
inline constexpr std::size_t kMaxCommandLine = 512;

// The kinds of lines. `request` stands for home, enable, disable, reset and estop.
enum class Verb : std::uint8_t { request, set, get, list, status, scene, record, inject, help };

// A parsed line. Its views point into the line.
struct CommandLine {
  Verb verb = Verb::help;
  // Used by `request`.
  Request request = Request::none;
  // Used by `set` and `get`.
  ParameterName name;
  // Used by `set`: the value in the parameter's unit, which may be infinite or not a number. For a
  // name it is the name's number, or kNoChoice (firmware/control/parameter_choices.h).
  double value = 0.0;
  // Used by `scene` and `record on`; empty for `record off`.
  std::string_view file;
  InjectionOrder injection;  // used by `inject`
};

// Returns the command, or a text that says what is wrong and what would be right. The result holds
// views into `line`.
std::expected<CommandLine, std::string_view> parse_command(std::string_view line);

// Returns the first word of the line, the name that a reply gives to the command.
std::string_view first_word(std::string_view line);

}  // namespace tactus::firmware
