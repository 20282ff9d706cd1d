// Colours of a terminal, where there is one that has them.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace tactus::host {

// Colours by their numbers in the terminal's palette (ECMA-48, SGR).
enum class TerminalColour { red = 31, green = 32, yellow = 33, cyan = 36 };

// Returns true if the stream is a terminal with colours, and NO_COLOR is not set.
inline bool has_colour(std::FILE* stream) {
  const char* const wish = std::getenv("NO_COLOR");
  const char* const kind = std::getenv("TERM");
  const bool is_plain =
      (wish != nullptr && *wish != '\0') || kind == nullptr || std::string_view(kind) == "dumb";
  return !is_plain && ::isatty(::fileno(stream)) == 1;
}

// Returns the text in a colour.
inline std::string coloured(std::string_view text, TerminalColour colour) {
  std::string all = "\033[" + std::to_string(static_cast<int>(colour)) + "m";
  all.append(text).append("\033[0m");
  return all;
}

}  // namespace tactus::host
