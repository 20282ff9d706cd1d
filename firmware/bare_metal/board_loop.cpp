#include "firmware/bare_metal/board_loop.h"

#include "firmware/bare_metal/stop.h"
#include "hal/bare_metal/board.h"
#include "rendering/profiles/chosen_profile.h"

namespace tactus::firmware {

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
