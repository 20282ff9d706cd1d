#include "rendering/contact/neighbourhood.h"

#include <algorithm>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// The trust ball is a few of the tool's steps wide, within these bounds: smaller and it is gathered
// too often, larger and it holds triangles that the sphere never meets.
constexpr double kTrustSteps = 3.0;
constexpr double kLeastTrust_m = 50e-6;
constexpr double kMostTrust_m = 1e-3;
// In free space the ball reaches to the surface, but no farther than this.
constexpr double kMostClearance_m = 0.1;

// Shrinks to the distance of the nearest triangle of any object.
struct Clearance {
  const Vec3& p;
  double nearest;
  const MeshView* mesh = nullptr;

  [[nodiscard]] double reach() const { return nearest; }
  void operator()(std::uint32_t t) {
    nearest = std::min(nearest, triangle_of(*mesh, t).nearest(p).distance);
  }
};

double clearance(std::span<const Object> objects, const Vec3& p) {
  Clearance visitor{.p = p, .nearest = kMostClearance_m};
  for (const Object& object : objects) {
    visitor.mesh = &object.mesh;
    visit_near(object.mesh.nodes, p, visitor);
  }
  return visitor.nearest;
}

}  // namespace

// Collects the candidates within a fixed reach; stops collecting, and says so, when there is no
// room.
struct Neighbourhood::Gather {
  Neighbourhood& to;
  const Vec3& p;
  double reach_m;
  const Object* object = nullptr;
  std::uint32_t object_index = 0;
  bool complete = true;

  [[nodiscard]] double reach() const { return complete ? reach_m : 0.0; }
  void operator()(std::uint32_t t) {
    const Triangle triangle = triangle_of(object->mesh, t);
    const double distance = triangle.nearest(p).distance;
    if (distance > reach_m) {
      return;
    }
    if (to.size_ == kMaxCandidates) {
      complete = false;
      return;
    }
    to.slots_[to.size_] = {triangle, object_index, object->sides == Sides::one};
    to.order_[to.size_] = {distance, static_cast<std::uint32_t>(to.size_)};
    ++to.size_;
  }
};

bool Neighbourhood::gather(std::span<const Object> objects, const Shell& shell, const Vec3& p,
                           double trust) {
  size_ = 0;
  ++gatherings_;
  Gather visitor{.to = *this, .p = p, .reach_m = shell.reach_m + trust};
  for (std::uint32_t i = 0; i < objects.size() && visitor.complete; ++i) {
    visitor.object = &objects[i];
    visitor.object_index = i;
    visit_near(objects[i].mesh.nodes, p, visitor);
  }
  peak_ = std::max(peak_, size_);
  if (!visitor.complete) {
    return false;
  }
  std::sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(size_),
            [](const Entry& a, const Entry& b) { return a.distance < b.distance; });
  centre_ = p;
  trust_m_ = trust;
  return true;
}

bool Neighbourhood::ensure(std::span<const Object> objects, const Shell& shell, const Vec3& p,
                           double step) {
  if (trust_from(p) >= std::min(step, kMostTrust_m)) {
    return true;
  }
  constexpr int kShrinkings = 8;
  double trust = std::clamp(kTrustSteps * step, kLeastTrust_m, kMostTrust_m);
  for (int k = 0; k < kShrinkings; ++k, trust *= 0.5) {
    if (gather(objects, shell, p, trust)) {
      if (size_ == 0) {
        trust_m_ = std::max(trust, clearance(objects, p) - shell.reach_m);
      }
      return k == 0;
    }
  }
  clear();
  return false;
}

}  // namespace tactus::rendering
