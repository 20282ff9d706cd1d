// A tick's explanation as a line of text, `name=value` separated by blanks, for grep and awk.
// `tactus watch --explain` prints it. The names are those of the file of `--explain`
// (host_tools/explain/README.md).
#pragma once

#include <string>
#include <string_view>

#include "firmware/telemetry/explanation.h"

namespace tactus::host {

// Returns the state of the lecture's diagram: free, face, edge or vertex.
std::string_view contact_state(const firmware::Explanation& explanation);

// Returns the state of friction: free, stick or slip.
std::string_view friction_word(const firmware::Explanation& explanation);

// Returns the line without its newline. Fields that the tick does not have are left out: the
// object without contact, the numbers of a formula's feature, the circles without a friction cone.
std::string explain_line(const firmware::Explanation& explanation);

}  // namespace tactus::host
