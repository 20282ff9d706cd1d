// Checks the name of a picture before a verb begins to work. The options --figure and --picture use
// it.
#pragma once

#include <string>

#include "host_tools/input_error.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {

// Returns what is wrong with the name of a picture, empty if nothing is; a check of CLI11.
inline std::string picture_complaint(const std::string& name) {
  try {
    static_cast<void>(picture_format(name));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace tactus::host
