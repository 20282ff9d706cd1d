#include "firmware/bare_metal/stop.h"

#include "hal/bare_metal/board.h"

namespace tactus::firmware {
namespace {

// The watchdog's time from a stop to the restart of the board: it must be enough to tell the stop.
constexpr std::uint32_t kTelling_us = 500'000;
// A line is given up after its characters were refused so often.
constexpr int kMostOffers = 1'000'000;

// Offers a character until it is taken or no offer is left.
void put_or_give_up(char character, int& offers) {
  while (offers > 0 && !hal::put_char(character)) {
    --offers;
  }
}

}  // namespace

void tell_now(std::string_view line) {
  int offers = kMostOffers;
  for (const char character : line) {
    put_or_give_up(character, offers);
  }
  put_or_give_up('\r', offers);
  put_or_give_up('\n', offers);
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
  // A frame may be under way, and a zero ends it (firmware/line/frame.h).
  int offers = kMostOffers;
  put_or_give_up('\0', offers);
  Line line = stop_line("stop", hal::latched_stop());
  if (!words.empty()) {
    line.add(": ").add(words);
  }
  tell_now(line.text());
  hal::halt();
}

}  // namespace tactus::firmware
