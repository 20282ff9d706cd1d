// Counts the reads in which a device gave no believable answer.
#pragma once

#include <cstdint>

namespace tactus::drivers {

// A bad read adds kBad, a good one subtracts 1. Three bad reads in a row are a fault, and so is a
// long run of which a quarter is bad.
class ReadScore {
 public:
  void good() { score_ -= score_ > 0 ? 1 : 0; }
  // Returns true if the device is at fault.
  bool bad() {
    score_ += kBad;
    return score_ >= kFault;
  }

 private:
  static constexpr std::uint32_t kBad = 3;
  static constexpr std::uint32_t kFault = 9;

  std::uint32_t score_ = 0;
};

}  // namespace tactus::drivers
