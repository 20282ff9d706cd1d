#include "firmware/linux/telemetry/places_source.h"

#include <Eigen/Geometry>

namespace tactus::firmware {
namespace {

ObjectPlace place_of(const rendering::Mover& mover) {
  const Eigen::Quaterniond q(mover.X_WO.rotation);
  return {.object = mover.object,
          .origin_W = to_triple(mover.X_WO.translation),
          .rotation_W = {q.w(), q.x(), q.y(), q.z()}};
}

}  // namespace

void PlacesSource::publish(const Controller& controller, std::int64_t due_ns,
                           TelemetryWriter& writer) {
  ObjectPlaces sample{.tick = controller.record().tick, .time_ns = due_ns};
  for (const rendering::Mover& mover : controller.world().movers()) {
    sample.places[sample.count] = place_of(mover);
    ++sample.count;
  }
  if (sample.count > 0) {
    writer.publish(sample);
  }
}

}  // namespace tactus::firmware
