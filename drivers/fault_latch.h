// What went wrong with one axis, kept until it is cleared.
#pragma once

#include <cstdint>

#include "drivers/axis.h"

namespace tactus::drivers {

// The first trouble stays in words, since what follows is mostly its consequence; the status bits
// of all of them add up.
class FaultLatch {
 public:
  void latch(DeviceStatus bit, const Trouble& trouble) {
    status_ |= bit | heat_status(trouble);
    if (!trouble_) {
      trouble_ = trouble;
    }
  }
  // For a device that names the cause of its fault only later.
  void explain(const Trouble& trouble) {
    status_ |= heat_status(trouble);
    trouble_ = trouble;
  }
  void clear() { *this = FaultLatch{}; }

  explicit operator bool() const { return status_ != kDeviceOk; }
  [[nodiscard]] std::uint32_t status() const { return status_; }
  [[nodiscard]] const Trouble& trouble() const { return trouble_; }

 private:
  std::uint32_t status_ = kDeviceOk;
  Trouble trouble_;
};

}  // namespace tactus::drivers
