// The contacts of a tick: which solids meet.
#include <algorithm>
#include <cmath>

#include "rendering/bodies/body_world.h"

namespace tactus::rendering {
namespace {

// Surfaces nearer than this, and what their motion in a tick may close, are looked at, m.
constexpr double kMargin_m = 5e-4;

// Returns the friction and the restitution of two surfaces: the geometric mean of the coefficients,
// and the larger of the other numbers.
ContactSurface shared_surface(const ContactSurface& a, const ContactSurface& b) {
  return {.friction = std::sqrt(a.friction * b.friction),
          .restitution = std::max(a.restitution, b.restitution),
          .rolling_m = std::max(a.rolling_m, b.rolling_m),
          .spinning_m = std::max(a.spinning_m, b.spinning_m)};
}

// Returns the largest speed of a point of a solid.
double fastest(const SolverBody& solid, const PlacedHull& hull) {
  const double reach = (hull.middle_W() - solid.center_W()).norm() + hull.reach_m();
  return solid.velocity().head<3>().norm() + reach * solid.velocity().tail<3>().norm();
}

// Returns the largest speed of a point that a solid carries along, within a hull's reach.
double fastest_at(const SolverBody& solid, const PlacedHull& hull) {
  return solid.velocity_at(hull.middle_W() - solid.center_W()).norm() +
         hull.reach_m() * solid.velocity().tail<3>().norm();
}

}  // namespace

double BodyWorld::place_hull(std::uint16_t solid, double tick_s) {
  if (!solids_.has_hull(solid)) {
    return 0.0;
  }
  hulls_.place(solids_, solid);
  return tick_s * fastest(solver_.velocities()[solid], hulls_.whole(solid));
}

double BodyWorld::margin_of(std::uint16_t a, std::uint16_t b, double tick_s,
                            const Margins& margins) {
  const double speed =
      solids_.has_hull(a) ? 0.0 : fastest_at(solver_.velocities()[a], hulls_.whole(b));
  return kMargin_m + margins[a] + margins[b] + tick_s * speed;
}

// Springs may drive a light body far within the tick. A contact begins with the velocities that the
// bodies have: only those tell a hit from a load.
void BodyWorld::find_contacts(double tick_s) {
  contacts_.begin_tick();
  const std::span<SolverBody> velocities = solver_.velocities();
  for (const std::uint8_t i : awake_.numbers()) {
    if (grips_.holds(i)) {
      grips_.hold(i, velocities[i]);
    }
  }
  Margins margins{};
  for (std::uint16_t i = 0; i < solids_.count(); ++i) {
    if (!solids_.is_body(i) || !sleep_.is_asleep(i)) {
      margins[i] = place_hull(i, tick_s);
    }
  }
  if (sleep_.is_on()) {
    wake_neighbours(tick_s, margins);
    contacts_.take_kept(sleep_);
  }
  for (const std::uint8_t i : awake_.numbers()) {
    velocities[i].begin(bodies()[i]);
  }
  for (const std::uint16_t b : awake_.numbers()) {
    for (std::uint16_t a = 0; a < solids_.count(); ++a) {
      const bool is_pair = !solids_.is_body(a) || (a < b && !sleep_.is_asleep(a));
      if (is_pair) {
        add_contacts(a, b, margin_of(a, b, tick_s, margins));
      }
    }
  }
}

void BodyWorld::add_contacts(std::uint16_t a, std::uint16_t b, double margin_m) {
  const auto manifolds = meeting_.find(solids_, hulls_, a, b, margin_m);
  if (meeting_.has_left_out()) {
    contacts_.leave_out();
  }
  if (manifolds.empty()) {
    return;
  }
  const ContactSurface surface = shared_surface(solids_.surface_of(a), solids_.surface_of(b));
  for (const Manifold& manifold : manifolds) {
    contacts_.add(a, b, surface, manifold, solver_.velocities());
  }
}

}  // namespace tactus::rendering
