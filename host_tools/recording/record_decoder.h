// Turns the messages of a recording or of the live socket back into structs. The bytes come from a
// file or a socket, so nothing in them is trusted.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/object_places.h"
#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::host {

// The run's notes about itself, as pairs of key and value in the sender's order. The keys are in
// firmware/telemetry/README.md.
using RunInfo = std::vector<std::pair<std::string, std::string>>;

// Each of these functions returns nothing if the bytes are not one whole and valid message of its
// kind; whatever the bytes are, nothing outside of them is read. An enumeration may have a value
// that this version does not know.
std::optional<firmware::RecordedTick> decode_tick(std::span<const std::byte> message);
std::optional<firmware::TelemetryEvent> decode_event(std::span<const std::byte> message);
std::optional<firmware::Explanation> decode_explanation(std::span<const std::byte> message);
std::optional<firmware::ObjectPlaces> decode_object_places(std::span<const std::byte> message);
std::optional<RunInfo> decode_run_info(std::span<const std::byte> message);

}  // namespace tactus::host
