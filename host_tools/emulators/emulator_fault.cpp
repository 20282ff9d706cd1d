#include "host_tools/emulators/emulator_fault.h"

#include <array>
#include <string>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {

EmulatorFault emulator_fault(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, EmulatorFault>, 7> kFaults = {{
      {"none", EmulatorFault::none},
      {"silent", EmulatorFault::silent},
      {"delayed", EmulatorFault::delayed},
      {"corrupted", EmulatorFault::corrupted},
      {"erroring", EmulatorFault::erroring},
      {"unplugged", EmulatorFault::unplugged},
      {"power_cycled", EmulatorFault::power_cycled},
  }};
  for (const auto& [known, fault] : kFaults) {
    if (known == name) {
      return fault;
    }
  }
  throw InputError("no fault '" + std::string(name) +
                   "'; there are: none, silent, delayed, corrupted, erroring, unplugged, "
                   "power_cycled");
}

void ActiveFault::set(EmulatorFault fault) {
  kind_ = fault;
  off_until_ns_.reset();
}

bool ActiveFault::has_power(hal::TimeNs now_ns) {
  if (is(EmulatorFault::power_cycled) && !off_until_ns_) {
    off_until_ns_ = now_ns + kPowerCycle_ns;
  }
  return !is(EmulatorFault::unplugged) && (!off_until_ns_ || now_ns >= *off_until_ns_);
}

void flip_a_bit(std::span<std::byte> bytes, std::mt19937& random) {
  std::uniform_int_distribution<std::size_t> bit(0, 8 * bytes.size() - 1);
  const std::size_t at = bit(random);
  bytes[at / 8] ^= static_cast<std::byte>(1U << (at % 8));
}

}  // namespace tactus::host
