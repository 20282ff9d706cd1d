// Chooses the one planted fault of a run. plant_faults puts calls of is_on into copies of the
// sources, each of which then includes a copy of this file.
#pragma once

// A fault may leave a variable unused, or make a condition that is always the same.
#pragma GCC diagnostic warning "-Wall"

#include <cstdlib>

namespace tactus::mutation {

// The number in TACTUS_MUTANT; 0, which no fault has, without one.
inline const int chosen = [] {
  const char* text = std::getenv("TACTUS_MUTANT");
  return text == nullptr ? 0 : std::atoi(text);
}();

inline bool is_on(int number) {
  return number == chosen;
}

}  // namespace tactus::mutation
