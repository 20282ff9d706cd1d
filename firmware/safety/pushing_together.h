// The parts of a scene that push the tool at one place together, held against the certificate.
//
// A hand feels the sum of what objects with a touch of their own (potential fields, feature walks,
// formulas) and effects do. Objects that share the proxy push as one, with a mean that is no larger
// than the largest of them (rendering/world/world.h), so one of them counts at a place: any of
// them. Those that coincide count with their sum all the same: nobody can tell which one is meant.
//
// Stiffnesses add as K n n^T where the directions are known (safety/stiffness_sum.h), and are alike
// in all directions elsewhere. Dampings add. Walls of the workspace count as parts. Every set of
// parts that can be felt together is held against the certificate, since fewer parts may have less
// damping than all of them.
//
// Not for a tick, but for the edge of one: no heap, bounded work. Pure functions of their
// arguments; any thread.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/safety/certificate.h"

namespace tactus::firmware {

// What is beyond the certificate where two parts or more are felt together; nothing if all of it is
// within. Parts by themselves are not looked at. The scene has at most kMaxObjects and kMaxEffects.
std::optional<UncertifiedPart> first_uncertified_together(const StiffnessCertificate& certificate,
                                                          const FeltScene& scene);

// The same of those sets that `object` belongs to.
std::optional<UncertifiedPart> first_uncertified_with(const StiffnessCertificate& certificate,
                                                      const FeltScene& scene, std::uint32_t object);

}  // namespace tactus::firmware
