// The faults of one axis, kept until they are cleared.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers {

// The words are those of the first fault, since later ones are mostly its consequences. The status
// bits of all faults add up.
class FaultLatch {
 public:
  // `bits` are of DeviceStatus.
  void latch(std::uint32_t bits, const Trouble& trouble) {
    status_ |= bits | heat_status(trouble);
    if (!trouble_) {
      trouble_ = trouble;
    }
  }
  // Replaces the words. Use it for a device that reports the cause of its fault later than the
  // fault.
  void explain(const Trouble& trouble) {
    status_ |= heat_status(trouble);
    trouble_ = trouble;
  }
  void clear() { *this = FaultLatch{}; }

  // A fault that is held must not be cleared before a read has reported it. The driver calls `hold`
  // with the fault and `show` at each read, and refuses to clear while `is_held`.
  void hold() { is_held_ = true; }
  void show() { is_held_ = false; }
  [[nodiscard]] bool is_held() const { return is_held_; }

  explicit operator bool() const { return status_ != kDeviceOk; }
  [[nodiscard]] std::uint32_t status() const { return status_; }
  [[nodiscard]] const Trouble& trouble() const { return trouble_; }

 private:
  std::uint32_t status_ = kDeviceOk;
  Trouble trouble_;
  bool is_held_ = false;  // no read has reported the fault yet
};

}  // namespace tactus::drivers
