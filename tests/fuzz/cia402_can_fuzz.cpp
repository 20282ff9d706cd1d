// Whatever a CiA 402 drive, or somebody who speaks in its name, sends and whenever: no position
// jump is reported as valid, and no torque beyond the limit, or at all without being well, goes
// out.

#include "tests/fuzz/cia402_can_run.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::Cia402Life{}.run({data, size});
  return 0;
}
