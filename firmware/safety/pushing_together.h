// Checks the parts of a scene that push the tool at one place together against the certificate.
//
// Objects with a contact of their own (potential fields, feature walks, formulas) and effects add
// up. Objects that share the proxy push as one, with a mean that is no larger than the largest of
// them (rendering/world/world.h), so one of them counts at a place, whichever it is. Objects that
// coincide count with their sum, because it is ambiguous which one is meant.
//
// Stiffnesses add as K n n^T where the directions are known (safety/stiffness_sum.h), and are equal
// in all directions elsewhere. Dampings add. Walls of the workspace count as parts. Every set of
// parts that can push together is checked, since fewer parts may have less damping than all of
// them.
//
// Not for a tick, but for the time between two ticks: it uses no heap, and its work is bounded. All
// are pure functions of their arguments, for any thread.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/safety/certificate.h"

namespace tactus::firmware {

// Returns the first two or more parts that are beyond the certificate together, or nothing if there
// are none. Single parts are not checked. The scene has at most kMaxObjects and kMaxEffects.
std::optional<UncertifiedPart> first_uncertified_together(const StiffnessCertificate& certificate,
                                                          const FeltScene& scene);

// Returns the same for the sets that contain `object`.
std::optional<UncertifiedPart> first_uncertified_with(const StiffnessCertificate& certificate,
                                                      const FeltScene& scene, std::uint32_t object);

}  // namespace tactus::firmware
