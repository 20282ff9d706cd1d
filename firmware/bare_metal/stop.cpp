#include "firmware/bare_metal/stop.h"

#include "hal/bare_metal/board.h"

namespace tactus::firmware {
namespace {

// The watchdog's time from a stop to the restart of the board: it must be enough to tell the stop.
constexpr std::uint32_t kTelling_us = 500'000;
// A line is given up after its characters were refused so often.
constexpr int kMostOffers = 1'000'000;

}  // namespace

void tell_now(std::string_view line) {
  int offers = kMostOffers;
  const auto put = [&](char character) {
    while (offers > 0 && !hal::put_char(character)) {
      --offers;
    }
  };
  for (const char character : line) {
    put(character);
  }
  put('\r');
  put('\n');
}

Line stop_line(std::string_view verb, const hal::LatchedStop& stop) {
  Line line;
  line.add(verb).add(static_cast<std::uint64_t>(stop.code));
  line.add(" ").add(hal::stop_name(stop.code));
  if (stop.address != 0) {
    line.add(" at").add_hex(stop.address);
  }
  return line;
}

void stop(hal::StopCode code, std::uint32_t address, std::string_view words) {
  hal::motors_off();
  // The watchdog interrupts a stop, too, since nothing feeds it any more: only the first stop is
  // told.
  if (hal::latched_code(hal::latched_stop()) != hal::StopCode::none) {
    hal::halt();
  }
  hal::latch(code, address, hal::latched_stop());
  hal::start_watchdog(kTelling_us);
  Line line = stop_line("stop", hal::latched_stop());
  if (!words.empty()) {
    line.add(": ").add(words);
  }
  tell_now(line.text());
  hal::halt();
}

}  // namespace tactus::firmware
