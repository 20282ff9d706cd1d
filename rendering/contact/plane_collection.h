// Collects the contact planes at the proxy: the second step of a sub-goal (proxy_tick.cpp).
//
// A triangle that is touched on its face gives its plane at once. One that is touched on an edge or
// a vertex gives its plane only when it blocks a sweep: across a flat or hollow seam the
// neighbour's edge is near too, its plane is tilted against the motion, and yet it never blocks.
// A seam with friction is left out where the sphere only meets it because it is below its rest
// height. Surfaces of two objects that lie flush have such a seam, too.
// At the start of a tick the edges that held a proxy with friction give their planes too: without
// them it would come down to the edge along the way to the tool, rise again, and so creep in every
// tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "rendering/contact/constraint_memory.h"
#include "rendering/contact/contact_planes.h"
#include "rendering/contact/last_contact.h"
#include "rendering/contact/nearby_surfaces.h"
#include "rendering/contact/proxy_rest.h"

namespace tactus::rendering {

// Collects contact planes at one position of the proxy, from which the candidates are measured
// (CandidateSet::move_to). A plane pushes the proxy to its rest height, but by at most `max_push_m`
// where the proxy overlaps the surface.
class PlaneCollector {
 public:
  PlaneCollector(const NearbySurfaces& near, const Vec3& p_W, double max_push_m)
      : near_(near), p_W_(p_W), max_push_m_(max_push_m) {}

  // The outcome of a collection.
  enum class Result : std::uint8_t {
    complete,    // `planes` are all
    overlapped,  // the proxy overlaps an object too much; it is left out now, so gather again
    unfinished,  // the tick's budget is spent before all near candidates are measured
  };
  // Collects the planes of the candidates in contact. Candidates that blocked a sweep in this tick,
  // those that are recalled, and those of `held_by` give their planes as well. `flags` gets
  // TouchFlags.
  Result collect(const ConstraintMemory& memory, const HeldBy& held_by, ContactPlanes& planes,
                 std::uint32_t& flags);

  // Adds the planes of the recalled candidates, at any distance.
  void add_recalled(const ConstraintMemory& memory, ContactPlanes& planes, std::uint32_t& flags);

  // Returns the rest height of the planes if the sphere is below it and meets candidate `i`, a seam
  // that it rubs, only because it is too low. World frame, m.
  [[nodiscard]] std::optional<Vec3> place_above_seam(std::size_t i, ContactPlanes& planes) const;

  // Adds the plane of candidate `i`, which blocked a sweep at its start. Returns true if it is new.
  bool add_blocking(std::size_t i, ContactPlanes& planes, std::uint32_t& flags);

  // Adds the plane of the face a little below a sphere that moved past the end of another face, if
  // there is one. The plane bounds the sphere there already, so the sphere need not come down first
  // to find it. `planes` must be empty.
  void add_face_below(ContactPlanes& planes, std::uint32_t& flags);

 private:
  // Adds the plane of candidate `i`, which is measured, or the plane of the candidate at another
  // contact with it. Returns true if it is new.
  bool add(std::size_t i, ContactPlanes& planes, std::uint32_t& flags);
  bool add(std::size_t i, const Nearest& nearest, ContactPlanes& planes, std::uint32_t& flags);
  // Adds the planes of the other contacts with candidate `i` if that is a primitive.
  void add_other_contacts(std::size_t i, ContactPlanes& planes, std::uint32_t& flags);
  // The candidates with friction that the sphere touches on an edge or a vertex.
  struct RubbingEdges {
    std::array<std::uint16_t, kMaxContactPlanes> numbers{};
    std::size_t count = 0;

    // Returns false if there are too many.
    bool add(std::uint16_t number) {
      if (count == numbers.size()) {
        return false;
      }
      numbers[count++] = number;
      return true;
    }
  };
  // Adds the planes of the edges, except of seams that the sphere is clear of at the rest height of
  // the planes that are there.
  void add_edges(const RubbingEdges& edges, ContactPlanes& planes, std::uint32_t& flags);
  // Returns true if the candidate is nearest on an edge or a vertex. Those of a primitive without
  // friction count as faces.
  [[nodiscard]] bool is_edge(const Candidate& candidate) const;
  // Returns true if the candidate's surface has friction.
  [[nodiscard]] bool rubs(const Candidate& candidate) const;
  // Returns true if candidate `i` rubs the sphere with an edge or a vertex beside a face that gave
  // one of the planes.
  [[nodiscard]] bool is_seam(std::size_t i, const ContactPlanes& planes) const;
  // Returns true if candidate `i` does not touch a sphere at p_W (world frame, m).
  [[nodiscard]] bool is_clear(std::size_t i, const Vec3& p_W) const;
  // Returns true if the proxy overlaps the candidate's surface by more than a push out may mend.
  [[nodiscard]] bool overlaps(const Candidate& candidate) const;

  const NearbySurfaces& near_;
  const Vec3& p_W_;
  // The most that an overlapping proxy is pushed out, m.
  double max_push_m_;
};

// Returns true if collecting the planes again at p_W, where a straight move on one plane ended,
// would find nothing new. This holds on a single face: its plane is the same, and other near
// triangles are touched at their borders, where they give no plane.
bool is_still_on_face(const NearbySurfaces& near, const Vec3& p_W, const ConstraintMemory& memory,
                      const ProxyRest& rest);

}  // namespace tactus::rendering
