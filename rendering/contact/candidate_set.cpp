// Measures candidates, and finds those within reach of a position. candidate_set_gather.cpp gathers
// them.
#include "rendering/contact/candidate_set.h"

#include <algorithm>
#include <new>

#include "rendering/contact/primitive_sweep.h"

namespace tactus::rendering {
// A moved object is near if its box comes within reach of the capsule, where it is now or where it
// was: triangles may have come in or gone.
void CandidateSet::begin_tick(const SceneObjects& scene) {
  progress_.may_pause = true;
  if (!scene.anything_moved() || trust_.is_empty()) {
    return;
  }
  const Vec3 middle = trust_.middle();
  const double reach =
      trust_.capsule.radius + 0.5 * trust_.capsule.axis.norm() + margins_.sphere.reach_m;
  const bool disturbed = std::ranges::any_of(scene.movers(), [&](const Mover& mover) {
    return mover.moved && (mover.is_near(middle, reach) || mover.was_near(middle, reach));
  });
  if (disturbed) {
    clear();
    trust_.plan.limit();
    progress_.may_pause = false;
  }
}

void CandidateSet::move_to_end(const Vec3& p) {
  move_to(p);
  reach_.move_there(p, now());
}

std::span<const std::uint16_t> CandidateSet::within_reach_here() {
  if (!reach_.knows(now())) {
    budget_.spend(size_ / kTangentsPerUnit);
    reach_.find_here(size_, place_.p, now());
  }
  return reach_.here();
}

std::span<const std::uint16_t> CandidateSet::within_reach(const Vec3& p, double farther_m) {
  budget_.spend(size_ / kTangentsPerUnit);
  return reach_.find_there(size_, p, farther_m);
}

// The triangle is built in its slot: a copy would move its 240 bytes.
void CandidateSet::build(Candidate& slot, const SceneObjects& scene) {
  ::new (&slot.triangle) Triangle(triangle_W(scene, slot.object, slot.index));  // in place
  slot.prepared = true;
}

const Nearest& CandidateSet::nearest(std::size_t i, const SceneObjects& scene) {
  Candidate& slot = slots_[i];
  if (is_measured(i)) {
    return slot.nearest;
  }
  slot.measured_at = place_.number;
  budget_.spend(kCostOfMeasurement);
  if (slot.primitive != nullptr) {
    measure_primitive(i);
    return slot.nearest;
  }
  prepare(slot, scene);
  // On a border the height is rounding where the sphere stands beside the triangle; its neighbour
  // across the border, or this one, must hold the sphere, so a nanometre behind still counts as in
  // front. On a face it does not: that is the far side.
  constexpr double kBesideBorder_m = -1e-9;
  ::new (&slot.nearest) Nearest(slot.triangle.nearest(place_.p));  // in place
  slot.behind =
      slot.one_sided && slot.triangle.height(place_.p) <
                            (slot.nearest.feature == Feature::face ? 0.0 : kBesideBorder_m);
  reach_.bounds().set_tangent(i, slot.nearest, place_.p, shorter_reach(i));
  return slot.nearest;
}

// The distance is convex only outside a convex solid; every other primitive gets no bound.
void CandidateSet::measure_primitive(std::size_t i) {
  Candidate& slot = slots_[i];
  slot.seen = sample(*slot.primitive, place_.p);
  const bool inside = slot.seen.distance_m < 0.0;
  slot.behind = slot.one_sided && inside;
  slot.nearest = nearest_of(slot.seen);
  if (!inside && convex(*slot.primitive)) {
    reach_.bounds().set_tangent(i, slot.nearest, place_.p, shorter_reach(i));
  } else {
    reach_.bounds().set_none(i);
  }
}

}  // namespace tactus::rendering
