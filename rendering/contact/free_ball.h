// Measures the free space around a place: the distance to anything that the proxy could touch.
#pragma once

#include "rendering/contact/sphere_sweep.h"
#include "rendering/objects/scene_objects.h"
#include "rendering/tick_budget.h"

namespace tactus::rendering {

// Returns a radius about p (world frame, m), beyond the contact margin's reach, within which the
// shared proxy can touch no surface. It is at least half of the largest possible radius, and at
// most 0.1 m. It is below `least_m`, and may be negative, if there is no such ball or the search
// gives up. The cost is added to `budget`.
double free_radius(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p,
                   double least_m, TickBudget& budget);

}  // namespace tactus::rendering
