// The columns of a tick as words and numbers for people and programs that read text: `tactus watch`
// prints them, `tactus foxglove` sends them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"

namespace tactus::host {

// The text of a column.
struct TickWord {
  std::string text;
  // False for modes, kinds, faults and hashes, whose texts are words.
  bool is_number = false;
};

// Writes the texts of all columns of a tick over `words`, in the order of column_names()
// (recording/record_columns.h). Numbers have nine digits; an enumeration's value that this version
// does not know is its number.
void read_words(const firmware::RecordedTick& tick, std::size_t joints,
                std::vector<TickWord>& words);

}  // namespace tactus::host
