// How far it is from a place in free space to anything that the proxy could touch.
#pragma once

#include "rendering/contact/sphere_sweep.h"
#include "rendering/contact/tick_budget.h"
#include "rendering/world/scene_objects.h"

namespace tactus::rendering {

// No surface that the shared proxy minds is nearer to p than this, beyond its reach; world frame,
// m. At least half of what it could be, which is found at a fraction of the cost, and never more
// than 0.1 m; less than `least_m`, and perhaps negative, where that is not so, or not soon found.
// Adds to `work` what it took.
double free_radius(const SceneObjects& scene, const ContactMargins& margins, const Vec3& p,
                   double least_m, TickBudget& budget);

}  // namespace tactus::rendering
