// Messages of a recording or of the live socket back as structs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "firmware/telemetry/telemetry_event.h"

namespace tactus::host {

using RunInfo = std::vector<std::pair<std::string, std::string>>;

// Each empty if the bytes are no such message, whole and sound; whatever they are, nothing outside
// of them is read. An enumeration's value may be one that this version does not know.
std::optional<firmware::RecordedTick> decode_tick(std::span<const std::byte> message);
std::optional<firmware::TelemetryEvent> decode_event(std::span<const std::byte> message);
std::optional<RunInfo> decode_run_info(std::span<const std::byte> message);

}  // namespace tactus::host
