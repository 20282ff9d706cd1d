// One function object of several, for std::visit.
#pragma once

namespace tactus::host {

// Calls the function that takes the alternative.
template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};

}  // namespace tactus::host
