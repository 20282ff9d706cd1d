// The exception of host tools for an error in the user's input.
#pragma once

#include <stdexcept>

namespace tactus::host {

// One line for the user: `file:line: what; remedy`. The program prints it and ends with exit
// code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tactus::host
