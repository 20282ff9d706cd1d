// Reads the list of faults that tests must find, and plants them in the text of a source file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tactus::mutation {

struct PlantedFault {
  int number = 0;  // from 1, in the order of the list
  std::string name;
  std::string file;  // from the repository's root
  std::string from;  // stands exactly once in the file
  std::string to;
  std::string program;  // the test program that finds it
  std::string filter;   // its --gtest_filter
  std::size_t line = 0;
};

// The list's form is in README.md. Throws std::runtime_error: `NAME:LINE: what; remedy`.
std::vector<PlantedFault> read_faults(const std::string& name, std::string_view text);

// Returns the source with every fault of that file in it, each behind a switch: an expression
// becomes `(is_on(n) ? (to) : (from))`, a statement or a block `if (is_on(n)) { to } else { from
// }`. The source then includes "planted_switch.h", which declares the switch (switch.h). Throws
// std::runtime_error if a fault's text does not stand there exactly once, or two overlap.
std::string with_faults(const std::string& list, const std::string& source,
                        const std::vector<PlantedFault>& faults);

}  // namespace tactus::mutation
