// The exception that every host tool throws for an error in the user's input. The controller has no
// exceptions; this type exists in host tools alone.
#pragma once

#include <stdexcept>

namespace tactus::host {

// The message is one line for the user: `file:line: what; remedy`. The program `tactus` catches it
// in main, prints it to stderr and ends with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace tactus::host
