// The words that a shell offers for the last word of a command line. They come from the options and
// verbs that the program itself reads, so that no list is kept by hand; completion.bash asks for
// them by `tactus complete WORD...`.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/cli/app_forward.h"

namespace tactus::host {

// Returns the values that a description lists, such as "The force: cone, dahl or lugre" or "png,
// svg, pdf"; empty if it lists none. A list has all of the description or of the clause after a
// colon, up to a remark after ; . or a comma.
std::vector<std::string> listed_values(std::string_view description);

// Returns what may stand in place of the last of the words that follow the program's name; verbs,
// options, or values of an option. It is empty where a file name or a number belongs. An option's
// values may be several, with commas.
std::vector<std::string> completions(const CLI::App& app, std::span<const std::string> words);

}  // namespace tactus::host
