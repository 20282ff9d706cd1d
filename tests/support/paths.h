// The places of the repository and of its programs, for tests that read examples or run a program.
//
// They are functions and not macros, so that the objects of the tests are the same wherever the
// repository lies, and ccache finds them again in a copy of it.
#pragma once

#include <string>
#include <string_view>

namespace tactus::testing {

// Returns the path of a file or folder, given from the repository's root.
std::string in_repository(std::string_view place);

// Returns the path of a program of this build, such as "tactus" or "tactusd".
std::string built_program(std::string_view name);

}  // namespace tactus::testing
