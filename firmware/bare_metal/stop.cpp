#include "firmware/bare_metal/stop.h"

#include "firmware/bare_metal/board_loop.h"
#include "hal/bare_metal/board.h"
#include "rendering/profiles/chosen_profile.h"

namespace tactus::firmware {
namespace {

// The watchdog's time from a stop to the restart of the board: it must be enough to tell the stop.
constexpr std::uint32_t kTelling_us = 500'000;
// How often a character is offered to a UART that does not take it.
constexpr int kMostOffers = 1'000'000;

// Tells a line at once, without the loop. A UART that takes nothing is given up.
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

}  // namespace

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

void begin(std::string_view board) {
  hal::motors_off();
  Line line;
  line.add("tactus on ").add(board).add(", profile ").add(rendering::kProfile.name);
  tell_now(line.text());
  const hal::LatchedStop& latched = hal::latched_stop();
  if (hal::latched_code(latched) != hal::StopCode::none) {
    tell_now(stop_line("stopped before:", latched)
                 .add("; the motors stay off until the power is cycled")
                 .text());
    hal::halt();
  }
}

void start_or_stop(LoadedController& loaded) {
  const hal::BoardImages images = hal::images();
  tell_now(image_line(images.device, images.scene).text());
  if (const auto started = loaded.start(images.device, images.scene); !started) {
    stop(started.error().code, 0, started.error().what);
  }
}

Line load_line(std::uint64_t ticks, const TickLoad& load, std::uint64_t missed) {
  Line line;
  line.add("load").add(ticks).add(" worst_ns").add(std::uint64_t{load.worst_ns()});
  line.add(" p99.9_ns").add(std::uint64_t{load.p999_ns()}).add(" missed").add(missed);
  line.add(" stack_bytes").add(std::uint64_t{used_bytes(hal::stack_memory(), hal::kStackPaint)});
  return line;
}

}  // namespace tactus::firmware
