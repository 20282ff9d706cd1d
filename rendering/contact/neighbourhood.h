// The triangles near the tool, kept from tick to tick: as long as the proxy stays within the trust
// ball about the place where they were gathered, no other triangle can touch the sphere and the
// hierarchy need not be asked again.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/contact/sphere_sweep.h"
#include "rendering/geometry/triangle.h"
#include "rendering/limits.h"
#include "rendering/world/object.h"

namespace tactus::rendering {

struct Candidate {
  Triangle triangle;
  std::uint32_t object = 0;
  bool one_sided = true;
};

class Neighbourhood {
 public:
  // Forgets everything; the next `ensure` gathers.
  void clear() { trust_m_ = -1.0; }

  // Makes the candidates valid about p, for a tool that moves about `step` metres a tick. False if
  // there were too many triangles for kMaxCandidates: then the trust ball is smaller than wanted,
  // or empty (trust_from(p) < 0) if even the smallest did not fit.
  bool ensure(std::span<const Object> objects, const Shell& shell, const Vec3& p, double step);

  // How far the proxy may move from p before the candidates must be gathered again; negative if p
  // itself is outside.
  [[nodiscard]] double trust_from(const Vec3& p) const { return trust_m_ - (p - centre_).norm(); }

  // Candidates by growing distance at the gathering.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const Candidate& candidate(std::size_t i) const { return slots_[order_[i].slot]; }

  // No position at a distance `moved` from the centre is nearer than this to candidate i or to any
  // after it.
  [[nodiscard]] double distance_bound(std::size_t i, double moved) const {
    return order_[i].distance - moved;
  }

  [[nodiscard]] double moved_from_centre(const Vec3& p) const { return (p - centre_).norm(); }
  [[nodiscard]] std::size_t peak() const { return peak_; }

  // Grows whenever the candidates change, and with them the meaning of their numbers.
  [[nodiscard]] std::size_t gatherings() const { return gatherings_; }

 private:
  struct Gather;
  struct Entry {
    double distance;
    std::uint32_t slot;
  };

  bool gather(std::span<const Object> objects, const Shell& shell, const Vec3& p, double trust);

  Vec3 centre_ = Vec3::Zero();
  double trust_m_ = -1.0;
  std::size_t size_ = 0;
  std::size_t peak_ = 0;
  std::size_t gatherings_ = 0;
  std::array<Entry, kMaxCandidates> order_{};
  std::array<Candidate, kMaxCandidates> slots_{};
};

}  // namespace tactus::rendering
