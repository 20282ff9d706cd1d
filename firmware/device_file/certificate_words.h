// Explains a device's certificate to its user in words. Not for a tick.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "firmware/control/controller.h"
#include "firmware/device_file/device_config.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {

// Returns the reason why scenes are not checked, with the command that changes that; empty if they
// are checked. The text is written into `room` and cut at its end.
std::string_view certificate_warning(const Certification& certification, std::span<char> room);

// The names of the objects that a refusal is about: first that of the part itself, then those of
// the others. They outlive the scene. Effects and objects without a name have an empty one. Names
// are cut at 63 bytes.
using PartNames = std::array<std::array<char, 64>, 1 + UncertifiedPart::kMostOthers>;
PartNames names_of(const UncertifiedPart& part, const rendering::SceneImage& scene);

// Returns which part is beyond the certificate, and a remedy, written into `room`.
std::string_view uncertified_words(const UncertifiedPart& part, const PartNames& names,
                                   std::span<char> room);

// Returns the reason why a scene was refused and a remedy, written into `room`. The names are those
// of `refusal.part`.
std::string_view refusal_words(const SceneRefusal& refusal, const PartNames& names,
                               std::span<char> room);

}  // namespace tactus::firmware
