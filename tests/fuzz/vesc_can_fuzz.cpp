// Whatever a VESC, or somebody who speaks in its name, sends and whenever: no position jump is
// reported as valid, and no torque beyond the limit, or at all without being well, goes out.

#include "tests/fuzz/vesc_can_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::VescLife{}.run({data, size});
  return 0;
}
