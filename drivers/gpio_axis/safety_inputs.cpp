#include "drivers/gpio_axis/safety_inputs.h"

namespace tactus::drivers {

void SafetyInputs::clear(hal::TimeNs now_ns) {
  emergency_stop_ = limits_.emergency_stop || now_ns - opened_ns_ < release_ns_;
  fault_ = limits_.fault;
}

}  // namespace tactus::drivers
