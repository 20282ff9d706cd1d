// Which rows of a long table of cases a test takes. See share.h for the same of random tests.
#pragma once

#include "tests/support/share.h"

namespace tactus::testing {

// Returns true for every row, or for one in `rows` where a sanitizer or emulation makes them slow.
inline bool is_taken(int rows = 8) {
  static int count = 0;
  return count++ % (rows / part_of(rows)) == 0;
}

}  // namespace tactus::testing
