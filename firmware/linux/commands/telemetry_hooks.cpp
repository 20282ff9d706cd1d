#include "firmware/linux/commands/telemetry_hooks.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/run_recorder.h"

namespace tactus::firmware {
namespace {

// The largest size of a recording's name, with its zero.
constexpr std::size_t kMaxRecordingName = 128;

TelemetrySinks& sinks_of(void* run) {
  return *static_cast<TelemetrySinks*>(run);
}

TelemetryWriter& writer_of(void* run) {
  return *sinks_of(run).writer;
}

std::string_view start_recording(void* run, std::string_view name) {
  const bool is_plain = !name.starts_with('.') && name.find('/') == std::string_view::npos;
  std::array<char, kMaxRecordingName> path{};
  if (!is_plain || !is_recording_name(name) || name.size() >= path.size()) {
    return "give a plain name that ends in .mcap or .csv; it is put into the controller's working "
           "folder";
  }
  std::ranges::copy(name, path.begin());
  const int failed = writer_of(run).record(path.data(), IfThere::refuse);
  if (failed == EEXIST) {
    return "there is a file of that name; give another";
  }
  return failed == 0 ? std::string_view{} : std::string_view(std::strerror(failed));
}

std::string_view stop_recording(void* run) {
  const int failed = writer_of(run).end_recording();
  return failed == 0 ? std::string_view{} : std::string_view(std::strerror(failed));
}

// Gives the new scene to all recordings and to the flight recorder, before the old one's memory is
// freed.
void scene_changed(void* run, std::span<const std::byte> image) {
  writer_of(run).attach(attachment_of(kSceneAttachment, image));
  for (TelemetryWriter* const companion : sinks_of(run).companions) {
    companion->attach(attachment_of(kSceneAttachment, image));
  }
  if (FlightWriter* const flight = sinks_of(run).flight; flight != nullptr) {
    flight->use_scene(image);
  }
}

// Publishes an event. A change of the scene also ends the flight recorder's history, because its
// ticks cannot be replayed with another scene.
void tell_event(void* to, const TelemetryEvent& event) {
  writer_of(to).publish(event);
  if (event.kind != EventKind::scene) {
    return;
  }
  for (TelemetryWriter* const companion : sinks_of(to).companions) {
    companion->publish(event);
  }
  if (FlightWriter* const flight = sinks_of(to).flight; flight != nullptr) {
    flight->leave_scene();
  }
}

}  // namespace

RunHooks telemetry_hooks(TelemetrySinks& sinks) {
  return {.run = &sinks,
          .start_recording = start_recording,
          .stop_recording = stop_recording,
          .scene_changed = scene_changed};
}

EventSink telemetry_events(TelemetrySinks& sinks) {
  return {.to = &sinks, .tell = tell_event};
}

}  // namespace tactus::firmware
