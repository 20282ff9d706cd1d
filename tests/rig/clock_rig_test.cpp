#include "hal/linux/clock.h"
#include "tests/unit/hal/clock_contract.h"

namespace tactus::hal {
namespace {

struct LinuxClockRig {
  Clock& clock() { return board_clock; }
  LinuxClock board_clock;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Linux, ClockContract, LinuxClockRig);

}  // namespace
}  // namespace tactus::hal
