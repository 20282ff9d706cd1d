// The controller's one table of trigger, reaction and recovery, as text.
#pragma once

#include <string>

namespace tactus::host {

// The table of firmware/README.md: a header and one row a code, each line ending in a newline.
std::string fault_table_markdown();

// `document` with its table of faults, from the header's line to the last row, replaced by
// fault_table_markdown(). Throws InputError if it has none.
std::string with_fault_table(const std::string& document);

// The same for a terminal.
std::string fault_table_text();

}  // namespace tactus::host
