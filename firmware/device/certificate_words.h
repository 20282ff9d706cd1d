// What a device's certificate means for its user, in words. Not for a tick.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "firmware/control/controller.h"
#include "firmware/device/device_config.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {

// Why scenes will not be checked, and the command that mends it; empty if they will be. Written
// into `room`, cut at its end.
std::string_view certificate_warning(const Certification& certification, std::span<char> room);

// The names of the objects that a refusal is about, which outlive the scene: first the part's own,
// then those of the others. Empty for an effect, and for an object without one. Cut at 63 bytes.
using PartNames = std::array<std::array<char, 64>, 1 + UncertifiedPart::kMostOthers>;
PartNames names_of(const UncertifiedPart& part, const rendering::SceneImage& scene);

// What is beyond the certificate, and what to do.
std::string_view uncertified_words(const UncertifiedPart& part, const PartNames& names,
                                   std::span<char> room);

// Why a scene was refused, and what to do. The names are those of `refusal.part`.
std::string_view refusal_words(const SceneRefusal& refusal, const PartNames& names,
                               std::span<char> room);

}  // namespace tactus::firmware
