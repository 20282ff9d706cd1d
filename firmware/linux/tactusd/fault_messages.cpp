#include "firmware/linux/tactusd/fault_messages.h"

#include <cstdio>
#include <string_view>

#include "firmware/linux/tactusd/messages.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {

void complain(const char* image, const OpenError& error) {
  const std::string_view code = hal::words(error.error.code);
  std::fprintf(stderr, "tactusd: %s: connection '%.*s': %.*s (%.*s, error %d)\n", image,
               length(error.connection), error.connection.data(), length(error.what),
               error.what.data(), length(code), code.data(), error.error.errno_value);
}

void explain_fault(std::uint64_t faults, const drivers::ComposedDevice& device) {
  for (const FaultText& text : kFaultTexts) {
    if ((faults & text.bit) != 0) {
      std::fprintf(stderr, "tactusd: fault %d %.*s: %.*s\n", fault_code(text.bit),
                   length(text.name), text.name.data(), length(text.meaning), text.meaning.data());
    }
  }
  const auto [joint, trouble] = device.trouble();
  if (trouble) {
    std::fprintf(stderr, "tactusd: joint '%.*s': %.*s (code 0x%x); %.*s\n", length(joint),
                 joint.data(), length(trouble.what), trouble.what.data(), trouble.code,
                 length(trouble.remedy), trouble.remedy.data());
  }
  const auto [unhomed, cause] = device.lost_reference();
  if (cause) {
    std::fprintf(stderr,
                 "tactusd: joint '%.*s' must be homed again because its zero may have "
                 "moved: %.*s; reset, then home\n",
                 length(unhomed), unhomed.data(), length(cause.what), cause.what.data());
  }
}

}  // namespace tactus::firmware
