// An input of the loop beside its samples. It is published when it takes effect, so that a
// recording holds all that is needed to repeat the run. Plain data and pure functions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace tactus::firmware {

// The kind of event, which gives `name` and `value` their meaning.
enum class EventKind : std::uint8_t {
  // The parameter `name` was set to `value` before the tick.
  parameter,
  // The scene changed to the attachment `name` before the tick.
  scene,
  // A request of this `name` was handed to the tick.
  request,
  // A fault of this `name`, with `value`, was injected before the tick.
  inject,
  // Information about the run: recording on, a reader refused.
  note
};
inline constexpr std::array<std::string_view, 5> kEventKindNames = {"parameter", "scene", "request",
                                                                    "inject", "note"};

// The name of an event `scene`, and of the attachment of a recording that has the scene's image.
inline constexpr std::string_view kSceneAttachment = "scene.tactus";

// One event.
struct TelemetryEvent {
  // The number of the first tick with it.
  std::uint64_t tick = 0;
  // LoopTimes::scheduled_ns of that tick.
  std::int64_t time_ns = 0;
  EventKind kind = EventKind::note;
  // The name, cut to 47 characters; shorter names end with a zero.
  std::array<char, 47> name{};
  double value = 0.0;
};
static_assert(std::is_trivially_copyable_v<TelemetryEvent>);

// Sets the name of the event and cuts it if it is too long.
inline void set_name(TelemetryEvent& event, std::string_view name) {
  event.name = {};
  std::copy_n(name.begin(), std::min(name.size(), event.name.size()), event.name.begin());
}

// Returns the name of the event as a view into it.
inline std::string_view name_of(const TelemetryEvent& event) {
  const auto end = std::ranges::find(event.name, '\0');
  return {event.name.data(), static_cast<std::size_t>(end - event.name.begin())};
}

}  // namespace tactus::firmware
