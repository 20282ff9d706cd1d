// The callback by which a long bake tells what it is doing.
#pragma once

#include <functional>
#include <string_view>

namespace tactus::host {

// Is called at the start of each step with a text like "bunny: reading bunny.ply".
using Progress = std::function<void(std::string_view step)>;

// Calls `progress` unless it is empty.
inline void tell(const Progress& progress, std::string_view step) {
  if (progress) {
    progress(step);
  }
}

}  // namespace tactus::host
