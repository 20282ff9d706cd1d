// The command socket's language: one command a line, words apart by spaces. README.md has the
// table.
//
// Bytes to numbers, no I/O; any thread; no heap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string_view>

#include "firmware/commands/injection.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameter_name.h"

namespace tactus::firmware {

// A line with its newline. Longer: refused, and skipped.
inline constexpr std::size_t kMaxCommandLine = 512;

enum class Verb : std::uint8_t { request, set, get, list, status, scene, record, inject, help };

struct CommandLine {
  Verb verb = Verb::help;
  Request request = Request::none;  // of `request`
  ParameterName name;               // of `set` and `get`; views into the line
  double value = 0.0;               // of `set`; may be infinite or no number
  std::string_view file;            // of `scene`, and of `record on`; empty for `record off`
  InjectionOrder injection;         // of `inject`
};

// The error says what is wrong and what would be right.
std::expected<CommandLine, std::string_view> parse_command(std::string_view line);

// The first word of a line: what a reply calls the command.
std::string_view first_word(std::string_view line);

}  // namespace tactus::firmware
