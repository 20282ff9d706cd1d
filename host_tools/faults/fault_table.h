// Prints the controller's faults and limits as text: code, trigger, reaction and recovery, from the
// one table in firmware/safety/faults.h. The verb `tactus faults` and a test of firmware/README.md
// call it.
#pragma once

#include <string>

namespace tactus::host {

// Returns the table of firmware/README.md in Markdown: a header and one row a code, each line
// ending in a newline.
std::string fault_table_markdown();

// Returns `document` with its table of faults, from the header's line to the last row, replaced by
// fault_table_markdown(). Throws InputError if the document has no line with the table's header.
std::string with_fault_table(const std::string& document);

// Returns the table for a terminal: two lines a code.
std::string fault_table_text();

// Returns a JSON array with an object for each code: its number, name, trigger, reaction and
// recovery.
std::string fault_table_json();

}  // namespace tactus::host
