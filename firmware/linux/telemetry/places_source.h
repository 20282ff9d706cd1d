// Publishes the places of the objects that move while a reader of the live telemetry wants them.
// The loop's thread.
#pragma once

#include <cstdint>

#include "firmware/control/controller.h"
#include "firmware/linux/telemetry/telemetry_writer.h"

namespace tactus::firmware {

// The most places a second: more than a display shows.
inline constexpr double kPlacesRate_Hz = 250.0;

// The places of a controller's world.
class PlacesSource {
 public:
  // Publishes the places after the tick if they are wanted, and enough time has gone since the last
  // ones. `due_ns` is LoopTimes::scheduled_ns of the tick. Real time: it reads one flag, or copies
  // a pose for each object that moves.
  void after_tick(const Controller& controller, std::int64_t due_ns, TelemetryWriter& writer) {
    if (writer.wants_places() && due_ns - published_ns_ >= kBetween_ns) {
      published_ns_ = due_ns;
      publish(controller, due_ns, writer);
    }
  }

 private:
  static constexpr auto kBetween_ns = static_cast<std::int64_t>(1e9 / kPlacesRate_Hz);

  static void publish(const Controller& controller, std::int64_t due_ns, TelemetryWriter& writer);

  std::int64_t published_ns_ = 0;
};

}  // namespace tactus::firmware
