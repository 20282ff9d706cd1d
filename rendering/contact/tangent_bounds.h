// Lower bounds of the distances from a point to convex shapes, one for each candidate.
//
// The distance to a convex shape is a convex function, so its tangent plane at any point is a lower
// bound everywhere. One dot product then shows for most candidates that they are out of reach. Four
// candidates are tested at a time, in floats: their rounding error is far smaller than the contact
// margin.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/geometry/floats.h"
#include "rendering/geometry/triangle.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// Numbers of candidates, ascending; the first `count` are in use.
struct CandidateNumbers {
  std::array<std::uint16_t, kMaxCandidates> numbers{};
  std::size_t count = 0;

  // Returns the numbers in use.
  [[nodiscard]] std::span<const std::uint16_t> all() const { return {numbers.data(), count}; }
};

// The bounds of all candidates. Candidate i lies behind its plane: from p it is at least normal_i .
// (p - origin) + height_i away. CandidateSet sets the planes and asks for those within reach.
class TangentBounds {
 public:
  // Starts over. Positions are taken relative to `origin`, so that floats are precise near it.
  // `reach_m` is the distance within which a candidate counts as within reach.
  void start(const Vec3& origin, double reach_m) {
    origin_ = origin;
    reach_m_ = reach_m;
  }

  // Sets the bound of candidate i: `distance_m` at the origin, and growing along the unit normal.
  // The candidate's own reach is shorter than that of start() by `shorter_m`.
  void set_at_origin(std::size_t i, const Float3& normal, double distance_m, double shorter_m) {
    normal_x_[i] = normal.x;
    normal_y_[i] = normal.y;
    normal_z_[i] = normal.z;
    height_[i] = static_cast<float>(distance_m + shorter_m);
  }

  // Sets the bound of candidate i to the tangent of its distance at `from`, where it was measured.
  void set_tangent(std::size_t i, const Nearest& nearest, const Vec3& from, double shorter_m) {
    const double at_origin = nearest.distance - nearest.normal.dot(from - origin_);
    set_at_origin(i, to_float3(nearest.normal), at_origin, shorter_m);
  }

  // Sets a bound that is within reach of every position.
  void set_none(std::size_t i) { set_at_origin(i, {}, -1.0, 0.0); }

  // Fills the last group of four after `size` candidates with entries that are out of reach.
  void fill_last_four(std::size_t size);

  // A position in the form that the test uses: metres from the origin, and the bound above which a
  // candidate is out of reach.
  struct Position {
    float x, y, z;  // m, from the origin
    float reach;    // m; a larger bound is out of reach
  };
  // Returns a position in that form, with a reach that covers the rounding to float.
  [[nodiscard]] Position at(const Vec3& p) const {
    // The rounding of a float dot product, as a share of the largest length involved.
    constexpr float kRounding = 1e-6F;
    const auto x = static_cast<float>(p.x() - origin_.x());
    const auto y = static_cast<float>(p.y() - origin_.y());
    const auto z = static_cast<float>(p.z() - origin_.z());
    const auto reach = static_cast<float>(reach_m_);
    return {.x = x,
            .y = y,
            .z = z,
            .reach = reach + kRounding * (reach + std::abs(x) + std::abs(y) + std::abs(z))};
  }

  // Returns false if the bound shows that candidate i is out of reach of the position.
  [[nodiscard]] bool may_reach(std::size_t i, const Position& at) const {
    return normal_x_[i] * at.x + normal_y_[i] * at.y + normal_z_[i] * at.z + height_[i] <= at.reach;
  }

  // Finds the candidates, of the first `size`, that may be within reach of p, with `farther_m`
  // added to the reach.
  void find(std::size_t size, const Vec3& p, double farther_m, CandidateNumbers& found) const;

  // Saves the bound of candidate i to the archive, or restores it.
  void transfer(StateArchive& archive, std::size_t i);

 private:
  // The origin of positions (world frame) and the reach, m.
  Vec3 origin_ = Vec3::Zero();
  double reach_m_ = 0.0;
  // The planes, one array a component, so that four of them load at once.
  alignas(Floats) std::array<float, kMaxCandidates> normal_x_{};
  alignas(Floats) std::array<float, kMaxCandidates> normal_y_{};
  alignas(Floats) std::array<float, kMaxCandidates> normal_z_{};
  alignas(Floats) std::array<float, kMaxCandidates> height_{};
};

}  // namespace tactus::rendering
