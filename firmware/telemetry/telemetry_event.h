// An input of the loop beside its samples. It is published when it takes effect, so that a
// recording holds all that is needed to repeat the run.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace tactus::firmware {

enum class EventKind : std::uint8_t {
  parameter,  // `name` was set to `value` before the tick
  scene,      // the scene changed to the attachment `name` before the tick
  request,    // a request of this `name` was handed to the tick
  inject,     // a fault of this `name`, with `value`, was injected before the tick
  note        // information: recording on, a reader refused
};
inline constexpr std::array<std::string_view, 5> kEventKindNames = {"parameter", "scene", "request",
                                                                    "inject", "note"};

struct TelemetryEvent {
  std::uint64_t tick = 0;    // the first tick with it
  std::int64_t time_ns = 0;  // LoopTimes::scheduled_ns of that tick
  EventKind kind = EventKind::note;
  std::array<char, 47> name{};  // ends with the first zero, if it has one
  double value = 0.0;
};
static_assert(std::is_trivially_copyable_v<TelemetryEvent>);

// Sets the name of the event and cuts it if it is too long.
inline void set_name(TelemetryEvent& event, std::string_view name) {
  event.name = {};
  std::copy_n(name.begin(), std::min(name.size(), event.name.size()), event.name.begin());
}

inline std::string_view name_of(const TelemetryEvent& event) {
  const auto end = std::ranges::find(event.name, '\0');
  return {event.name.data(), static_cast<std::size_t>(end - event.name.begin())};
}

}  // namespace tactus::firmware
