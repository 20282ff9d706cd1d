#include "rendering/contact/constraint_memory.h"

#include <algorithm>

namespace tactus::rendering {

void ConstraintMemory::leave(const Vec3& p, const ProxyRest& rest, std::size_t count) {
  held_count_ = count;
  left_from_ = p;
  for (std::size_t i = 0; i < count; ++i) {
    held_by_[i] = static_cast<std::uint16_t>(rest.planes[i].candidate);
  }
}

bool ConstraintMemory::would_cycle(const Vec3& p, const Vec3& goal, const Vec3& h) const {
  // A goal nearer to the place that the proxy left than a quarter of the move from there returns to
  // it.
  constexpr double kMaxShareOfMove = 0.25;
  return held_count_ > 0 &&
         ((goal - h).squaredNorm() >= (left_from_ - h).squaredNorm() ||
          (goal - left_from_).norm() <= kMaxShareOfMove * (p - left_from_).norm());
}

// A candidate whose plane is there already would change nothing.
bool ConstraintMemory::recall(const ContactPlanes& planes) {
  const std::size_t before = recalled_count_;
  for (const std::uint16_t candidate : std::span(held_by_).first(held_count_)) {
    const bool is_there =
        planes.has(candidate) || std::ranges::find(recalled(), candidate) != recalled().end();
    if (recalled_count_ < recalled_.size() && !is_there) {
      recalled_[recalled_count_++] = candidate;
    }
  }
  return recalled_count_ > before;
}

void ConstraintMemory::add_blocking(std::size_t candidate) {
  if (blocking_count_ < blocking_.size() && !is_blocking(candidate)) {
    blocking_[blocking_count_++] = static_cast<std::uint16_t>(candidate);
  }
}

}  // namespace tactus::rendering
