// What a device's certificate means for its user, in words. Not for a tick.
#pragma once

#include <span>
#include <string_view>

#include "firmware/control/controller.h"
#include "firmware/device/device_config.h"

namespace tactus::firmware {

// Why scenes will not be checked, and the command that mends it; empty if they will be. Written
// into `room`, cut at its end.
std::string_view certificate_warning(const Certification& certification, std::span<char> room);

// Why a scene was refused, and what to do. `name` is of the object that the refusal is about.
std::string_view refusal_words(const SceneRefusal& refusal, std::string_view name,
                               std::span<char> room);

}  // namespace tactus::firmware
