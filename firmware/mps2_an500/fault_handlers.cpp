// The handlers of everything that the processor finds wrong, and of the watchdog.
#include <cstdint>

#include "firmware/bare_metal/stop.h"
#include "firmware/mps2_an500/memory_map.h"
#include "firmware/mps2_an500/registers.h"

extern "C" {
void fault_handler();
[[noreturn]] void fault_found(std::uint32_t exception, const std::uint32_t* frame);
}

namespace tactus::mps2_an500 {
namespace {

static_assert(kLamps == 0x4002'8000, "fault_handler and reset_handler write this address");

// Returns true if the access that the MPU refused was to the guard, or was the processor's own when
// it put the interrupted program's registers on that program's stack.
bool is_stack_overflow() {
  const std::uint32_t status = reg(kFaultStatus);
  if ((status & kStackingRefused) != 0) {
    return true;
  }
  const auto guard = static_cast<std::uint32_t>(std::bit_cast<Address>(&guard_begin));
  const std::uint32_t address = reg(kFaultAddress);
  return (status & kAddressIsValid) != 0 && address >= guard && address - guard < kGuardBytes;
}

hal::StopCode code_of(std::uint32_t exception) {
  switch (exception) {
    case 2:
      return hal::StopCode::watchdog;
    case 3:
      return hal::StopCode::hard_fault;
    case 4:
      return is_stack_overflow() ? hal::StopCode::stack_overflow : hal::StopCode::memory_access;
    case 5:
      return hal::StopCode::bus;
    case 6:
      return hal::StopCode::instruction;
    default:
      return hal::StopCode::interrupt;
  }
}

}  // namespace
}  // namespace tactus::mps2_an500

// The first four instructions take the motors' power. They use no memory but the switch. Then the
// handler takes its stack from its beginning, since it never returns.
[[gnu::naked]] void fault_handler() {
  asm volatile(
      "movw r0, #0x8000\n"  // kLamps
      "movt r0, #0x4002\n"
      "movs r1, #0\n"
      "str r1, [r0]\n"
      "mrs r0, ipsr\n"
      "mrs r1, psp\n"
      "ldr r2, =handler_stack_end\n"
      "msr msp, r2\n"
      "b fault_found\n");
}

void fault_found(std::uint32_t exception, const std::uint32_t* frame) {
  using namespace tactus::mps2_an500;  // NOLINT(google-build-using-namespace)
  // The seventh word of the frame is the address of the interrupted instruction. A frame that did
  // not fit has none.
  constexpr int kAddressWord = 6;
  const bool has_frame = frame >= &stack_begin && frame + kAddressWord < &stack_end;
  tactus::firmware::stop(code_of(exception), has_frame ? frame[kAddressWord] : 0);
}
