#include "rendering/objects/still_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// Returns the next floats beyond p toward a side, so that a box never loses what it holds.
Float3 rounded(const Vec3& p, float toward) {
  const auto away = [toward](double x) { return std::nextafter(static_cast<float>(x), toward); };
  return {away(p.x()), away(p.y()), away(p.z())};
}

// Enlarges a node's box by an object's.
void grow(BvhNode& box, const Bounds& by) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const Float3 lower = rounded(by.lower_W, -kFar);
  const Float3 upper = rounded(by.upper_W, kFar);
  box.lower = {std::min(box.lower.x, lower.x), std::min(box.lower.y, lower.y),
               std::min(box.lower.z, lower.z)};
  box.upper = {std::max(box.upper.x, upper.x), std::max(box.upper.y, upper.y),
               std::max(box.upper.z, upper.z)};
}

// Returns the centre of the object's box.
Vec3 centre(const Object& object) {
  const Bounds box = bounds_of(object);
  return 0.5 * (box.lower_W + box.upper_W);
}

}  // namespace

void StillHierarchy::build(std::span<const Object> objects, const ChangedObjects& changed) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (meets_proxy(changed.of(i, objects[i])) && !is_mover(objects[i])) {
      order_[count++] = i;
    }
  }
  node_count_ = 0;
  if (count == 0) {
    return;
  }
  // The objects of a leaf.
  constexpr std::uint32_t kLeaf = 2;
  // Depth first on a fixed stack: each level leaves one part waiting.
  std::array<Part, kMaxHierarchyDepth> parts;
  std::size_t waiting = 0;
  parts[waiting++] = {.node = 0, .first = 0, .count = count};
  node_count_ = 1;
  while (waiting > 0) {
    const Part part = parts[--waiting];
    const Eigen::Index axis = enclose(objects, part);
    BvhNode& box = nodes_[part.node];
    if (part.count <= kLeaf) {
      box.first = part.first;
      box.triangle_count = part.count;
      continue;
    }
    const std::uint32_t half = part.count / 2;
    halve(objects, part, axis);
    box.first = static_cast<std::uint32_t>(node_count_);
    node_count_ += 2;
    parts[waiting++] = {.node = box.first, .first = part.first, .count = half};
    parts[waiting++] = {
        .node = box.first + 1, .first = part.first + half, .count = part.count - half};
  }
}

// Sets the box of the part's node, and returns the axis along which its objects are spread most.
Eigen::Index StillHierarchy::enclose(std::span<const Object> objects, const Part& part) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  BvhNode& box = nodes_[part.node];
  box = {.lower = {kFar, kFar, kFar}, .upper = {-kFar, -kFar, -kFar}};
  Eigen::AlignedBox3d centres;
  for (const std::uint32_t number : std::span(order_).subspan(part.first, part.count)) {
    grow(box, bounds_of(objects[number]));
    centres.extend(centre(objects[number]));
  }
  Eigen::Index widest = 0;
  centres.sizes().maxCoeff(&widest);
  return widest;
}

// Objects at equal places are ordered by their number, so that the hierarchy is the same on every
// machine.
void StillHierarchy::halve(std::span<const Object> objects, const Part& part, Eigen::Index axis) {
  const auto range = std::span(order_).subspan(part.first, part.count);
  std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(part.count / 2),
                           [&](std::uint32_t a, std::uint32_t b) {
                             const double of_a = centre(objects[a])[axis];
                             const double of_b = centre(objects[b])[axis];
                             return of_a < of_b || (of_a == of_b && a < b);
                           });
}

}  // namespace tactus::rendering
