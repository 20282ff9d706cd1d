// The contacts of a tick: which solids meet, and which of them wake others.
#include <algorithm>
#include <cmath>

#include "rendering/bodies/body_world.h"
#include "rendering/bodies/buried_contact.h"

namespace tactus::rendering {
namespace {

// Surfaces nearer than this, and what their motion in a tick may close, are looked at, m.
constexpr double kMargin_m = 5e-4;
// A contact goes on from tick to tick while its normal turns by less than the arccosine of this.
constexpr double kSameContact = 0.5;

// Returns the friction and the restitution of two surfaces: the geometric mean of the coefficients,
// and the larger of the other numbers.
ContactSurface surface_of(const ContactSurface& a, const ContactSurface& b) {
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

// Returns true if the spheres about two hulls are farther apart than the margin.
bool are_apart(const PlacedHull& a, const PlacedHull& b, double margin_m) {
  const double reach_m = a.reach_m() + b.reach_m() + margin_m;
  return (a.middle_W() - b.middle_W()).squaredNorm() > reach_m * reach_m;
}

// Returns the pose of a frame, seen from another one.
RigidPose seen_from(const RigidPose& X_WO, const RigidPose& X_WB) {
  return {.rotation = X_WO.rotation.transpose() * X_WB.rotation,
          .translation = X_WO.point_in(X_WB.translation)};
}

// Returns a manifold of a frame as one of the world.
Manifold in_world(Manifold manifold, const RigidPose& X_WO) {
  manifold.normal_W = X_WO.direction(manifold.normal_W);
  for (ManifoldPoint& point : std::span(manifold.points).first(manifold.count)) {
    point.point_W = X_WO.point(point.point_W);
  }
  return manifold;
}

}  // namespace

void BodyWorld::remember_contacts() {
  std::transform(contacts_.begin(), contacts_.begin() + static_cast<std::ptrdiff_t>(contact_count_),
                 contacts_before_.begin(), past_of);
  contact_count_before_ = contact_count_;
  contact_count_ = 0;
  left_out_ = false;
}

double BodyWorld::place_hull(std::uint16_t solid, double tick_s) {
  if (solid < body_count_) {
    place_body(solid);
  } else {
    const BodyObstacle& obstacle = obstacles_[solid - body_count_];
    if (obstacle.hull.vertices_O.empty()) {
      return 0.0;
    }
    hulls_[solid].place(obstacle.hull, obstacle.X_WO);
  }
  return tick_s * fastest(solids_[solid], hulls_[solid]);
}

void BodyWorld::place_body(std::size_t body) {
  const BodyStart& start = starts_[body];
  const RigidPose X_WO = bodies_[body].pose();
  if (start.parts.empty()) {
    hulls_[body].place(start.body.hull, X_WO);
    return;
  }
  const auto placed = std::span(part_hulls_).subspan(first_part_[body], start.parts.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].place(start.parts[i], X_WO);
  }
  hulls_[body].enclose(placed);
}

bool BodyWorld::has_hull(std::uint16_t solid) const {
  return solid < body_count_ || !obstacles_[solid - body_count_].hull.vertices_O.empty();
}

double BodyWorld::margin_of(std::uint16_t a, std::uint16_t b, double tick_s,
                            const Margins& margins) const {
  const double speed = has_hull(a) ? 0.0 : fastest_at(solids_[a], hulls_[b]);
  return kMargin_m + margins[a] + margins[b] + tick_s * speed;
}

// Springs may drive a light body far within the tick. A contact begins with the velocities that the
// bodies have: only those tell a hit from a load.
void BodyWorld::find_contacts(double tick_s) {
  remember_contacts();
  for (const std::uint8_t i : awake()) {
    if (grips_.holds(i)) {
      grips_.hold(i, solids_[i]);
    }
  }
  Margins margins{};
  const auto solid_count = static_cast<std::uint16_t>(body_count_ + obstacle_count_);
  for (std::uint16_t i = 0; i < solid_count; ++i) {
    if (i >= body_count_ || !sleep_.is_asleep(i)) {
      margins[i] = place_hull(i, tick_s);
    }
  }
  if (sleep_.is_on()) {
    wake_neighbours(tick_s, margins);
    contact_count_before_ +=
        sleep_.take_contacts(std::span(contacts_before_).subspan(contact_count_before_));
  }
  for (const std::uint8_t i : awake()) {
    solids_[i].begin(bodies_[i]);
  }
  for (const std::uint16_t b : awake()) {
    for (std::uint16_t a = 0; a < solid_count; ++a) {
      const bool is_pair = a >= body_count_ || (a < b && !sleep_.is_asleep(a));
      if (is_pair) {
        find_contacts_with(a, b, margin_of(a, b, tick_s, margins));
      }
    }
  }
}

// A solid of one part is met as a whole. The contacts of parts are joined first.
void BodyWorld::find_contacts_with(std::uint16_t a, std::uint16_t b, double margin_m) {
  if (part_count_ == 0 || parts_of(a).size() + parts_of(b).size() == 2) {
    if (has_hull(a)) {
      add_contact(a, b, manifold_of(hulls_[a], hulls_[b], margin_m));
    } else {
      meet_surface(a, b, hulls_[b], margin_m,
                   [&](const Manifold& manifold) { add_contact(a, b, manifold); });
    }
    return;
  }
  joined_.clear();
  if (has_hull(a)) {
    join_parts(a, b, margin_m);
  } else {
    for (const PlacedHull& part : parts_of(b)) {
      meet_surface(a, b, part, margin_m, [&](const Manifold& manifold) {
        if (!is_buried(parts_of(b), part, manifold, -1.0)) {
          joined_.add(manifold);
        }
      });
    }
  }
  for (const Manifold& manifold : joined_.all()) {
    add_contact(a, b, manifold);
  }
  left_out_ = left_out_ || joined_.has_left_out();
}

void BodyWorld::join_parts(std::uint16_t a, std::uint16_t b, double margin_m) {
  if (are_apart(hulls_[a], hulls_[b], margin_m)) {
    return;
  }
  for (const PlacedHull& part_b : parts_of(b)) {
    if (are_apart(hulls_[a], part_b, margin_m)) {
      continue;
    }
    for (const PlacedHull& part_a : parts_of(a)) {
      if (are_apart(part_a, part_b, margin_m)) {
        continue;
      }
      const Manifold manifold = manifold_of(part_a, part_b, margin_m);
      if (!is_buried(parts_of(a), part_a, manifold, 1.0) &&
          !is_buried(parts_of(b), part_b, manifold, -1.0)) {
        joined_.add(manifold);
      }
    }
  }
}

template <class Take>
void BodyWorld::meet_surface(std::uint16_t a, std::uint16_t b, const PlacedHull& hull_b,
                             double margin_m, const Take& take) {
  const BodyObstacle& obstacle = obstacles_[a - body_count_];
  const RigidPose& X_WO = obstacle.X_WO;
  const bool is_mesh = !obstacle.mesh.triangles.empty();
  if (!is_mesh && !obstacle.field.is_there()) {
    take(manifold_of(X_WO.point(obstacle.plane_O.translation),
                     X_WO.direction(obstacle.plane_O.rotation.col(1)), hull_b, margin_m));
    return;
  }
  seen_.place(hull_b.hull(), seen_from(X_WO, bodies_[b].pose()));
  const auto manifolds = is_mesh
                             ? mesh_contact_.find(obstacle.mesh, obstacle.sides, seen_, margin_m)
                             : field_contact_.find(obstacle.field, seen_, margin_m);
  for (const Manifold& manifold : manifolds) {
    take(in_world(manifold, X_WO));
  }
  left_out_ = left_out_ || (is_mesh && mesh_contact_.has_left_out());
}

void BodyWorld::add_contact(std::uint16_t a, std::uint16_t b, const Manifold& manifold) {
  if (manifold.count == 0) {
    return;
  }
  if (contact_count_ == kMaxBodyContacts) {
    left_out_ = true;
    return;
  }
  // The same contact in the last tick: of several the one with the most similar normal.
  const PastContact* before = nullptr;
  double likeness = kSameContact;
  for (const PastContact& old : std::span(contacts_before_).first(contact_count_before_)) {
    if (old.a == a && old.b == b && old.axes_W[0].dot(manifold.normal_W) > likeness) {
      before = &old;
      likeness = old.axes_W[0].dot(manifold.normal_W);
    }
  }
  const ContactSurface& of_a =
      a < body_count_ ? starts_[a].surface : obstacles_[a - body_count_].surface;
  BodyContact& contact = contacts_[contact_count_++];
  contact.a = a;
  contact.b = b;
  contact.surface = surface_of(of_a, starts_[b].surface);
  begin_contact(manifold, solids_, before, contact);
}

}  // namespace tactus::rendering
