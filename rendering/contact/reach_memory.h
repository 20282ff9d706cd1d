// The candidates within reach of the proxy and of the end of its last sweep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/contact/tangent_bounds.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// The lower bounds of the candidates' distances, and what the last searches among them found.
// Positions are in the world frame, m.
class ReachMemory {
 public:
  // The number of a position, from 1 on, and of a gathering. A result is valid for one key.
  struct Key {
    std::uint64_t place = 0;
    std::size_t gathering = 0;

    bool operator==(const Key&) const = default;
  };

  // Returns the bounds, which the candidate set fills.
  [[nodiscard]] TangentBounds& bounds() { return bounds_; }
  [[nodiscard]] const TangentBounds& bounds() const { return bounds_; }

  // Returns true if here() is valid for the key.
  [[nodiscard]] bool knows(const Key& now) const { return known_for_ == now; }
  // Finds the candidates, of the first `size`, within reach of the position p of the key.
  void find_here(std::size_t size, const Vec3& p, const Key& now) {
    bounds_.find(size, p, 0.0, here_);
    known_for_ = now;
  }
  // Returns the candidates of the last find_here or move_there.
  [[nodiscard]] std::span<const std::uint16_t> here() const { return here_.all(); }
  // Makes here() invalid for every key.
  void forget() { known_for_.place = 0; }

  // Returns the candidates, of the first `size`, within reach of p with `farther_m` added to the
  // reach. The span is valid until the next call.
  std::span<const std::uint16_t> find_there(std::size_t size, const Vec3& p, double farther_m) {
    bounds_.find(size, p, farther_m, there_);
    return there_.all();
  }
  // Moves to the p of the last find_there, whose key is `now`. The candidates within reach are
  // among those that it found; the tangents of those measured since may rule out some of them.
  void move_there(const Vec3& p, const Key& now);

  // Saves the candidates here to the archive, or restores them, if they are valid for the key. A
  // new search could lack those that the tangents have put out of reach since.
  void transfer(StateArchive& archive, std::size_t size, const Key& now);

 private:
  TangentBounds bounds_;
  CandidateNumbers here_;
  Key known_for_;
  CandidateNumbers there_;
};

}  // namespace tactus::rendering
