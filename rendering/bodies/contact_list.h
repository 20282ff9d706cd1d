// The contacts of the bodies of a world. A contact that goes on from tick to tick keeps its
// impulses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/body_sleep.h"
#include "rendering/bodies/manifold.h"
#include "rendering/bodies/solver_body.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// Lives in static storage; no heap.
class ContactList {
 public:
  // Forgets all contacts.
  void clear();
  // Begins the contacts of a tick: those of the last one are kept for their impulses alone.
  void begin_tick();
  // Adds those to the contacts of the last tick that were kept for bodies that are awake now.
  void take_kept(BodySleep& sleep);
  // Adds the contact of solids `a` and `b` in this tick. Beyond kMaxBodyContacts it is left out.
  void add(std::uint16_t a, std::uint16_t b, const ContactSurface& surface,
           const Manifold& manifold, std::span<const SolverBody> bodies);
  // Notes that the tick has contacts that are not in the list.
  void leave_out() { left_out_ = true; }

  // Returns the contacts of this tick, or of the last one before the first begin_tick().
  [[nodiscard]] std::span<BodyContact> all() { return {contacts_.data(), count_}; }
  [[nodiscard]] std::span<const BodyContact> all() const { return {contacts_.data(), count_}; }
  [[nodiscard]] bool has_left_out() const { return left_out_; }

  // Saves the state to the archive, or restores it. `solids` is one more than the largest number of
  // a solid; `any_resists_turning` is true if the surface of any body does.
  void transfer(StateArchive& archive, std::uint16_t solids, bool any_resists_turning);

 private:
  // Returns the same contact in the last tick, or nullptr: of several the one with the most similar
  // normal.
  [[nodiscard]] const PastContact* past(std::uint16_t a, std::uint16_t b,
                                        const Vec3& normal_W) const;

  std::array<BodyContact, kMaxBodyContacts> contacts_;
  std::size_t count_ = 0;
  bool left_out_ = false;
  // The contacts of the last tick, and those of bodies that have woken.
  std::array<PastContact, 2 * kMaxBodyContacts> before_;
  std::size_t before_count_ = 0;
};

}  // namespace tactus::rendering
