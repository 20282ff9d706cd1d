// Saves and restores the bodies of a world: their motion, and the impulses of their contacts.
#include <algorithm>
#include <span>

#include "rendering/bodies/body_sleep.h"
#include "rendering/bodies/body_world.h"
#include "rendering/bodies/contact_list.h"
#include "rendering/state_archive.h"
#include "rendering/world/world_bodies.h"

namespace tactus::rendering {
namespace {

void transfer_motion(StateArchive& archive, RigidBody& body) {
  BodyMotion motion = body.motion();
  auto& [center_W, velocity_W, rotation_WO, angular_momentum_W] = motion;
  archive(center_W, velocity_W, rotation_WO, angular_momentum_W);
  if (archive.is_reading() && archive.good()) {
    body.set_motion(motion);
  }
}

// The next tick takes over impulses by the points' places.
void transfer_contact(StateArchive& archive, BodyContact& contact, std::uint16_t solids,
                      bool any_resists_turning) {
  auto& [a, b, pushes_a, surface, axes_W, points, count, hits, about, torque] = contact;
  archive.up_to(a, solids);
  archive.up_to(b, solids);
  archive(axes_W);
  archive.up_to(count, kManifoldPoints);
  for (std::size_t i = 0; i < count && archive.good(); ++i) {
    archive(points[i].arm_b_W, points[i].push, points[i].rub);
  }
  if (any_resists_turning) {
    archive(torque);
  }
}

}  // namespace

// Islands are numbered by their smallest body; a state in which one is not is refused.
void BodySleep::transfer(StateArchive& archive, std::uint16_t bodies, std::uint16_t solids) {
  if (!is_on()) {
    return;
  }
  for (std::size_t i = 0; i < bodies; ++i) {
    archive(still_s_[i], island_[i]);
    archive.require(island_[i] == kAwake || island_[i] <= i);
    island_[i] = archive.good() ? island_[i] : kAwake;
  }
  archive.up_to(contact_count_, kMaxBodyContacts);
  for (PastContact& contact : std::span(contacts_).first(contact_count_)) {
    archive.up_to(contact.a, solids);
    archive.up_to(contact.b, static_cast<std::uint16_t>(std::max<int>(bodies, 1) - 1));
    archive(contact.axes_W, contact.torque);
    archive.up_to(contact.count, kManifoldPoints);
    for (PastPoint& point : std::span(contact.points).first(contact.count)) {
      archive(point.arm_b_W, point.push, point.rub);
    }
  }
}

void ContactList::transfer(StateArchive& archive, std::uint16_t solids, bool any_resists_turning) {
  archive.up_to(count_, kMaxBodyContacts);
  for (std::size_t i = 0; i < count_ && archive.good(); ++i) {
    transfer_contact(archive, contacts_[i], solids, any_resists_turning);
  }
}

void BodyWorld::transfer(StateArchive& archive) {
  const std::uint16_t bodies = solids_.body_count();
  archive.same(bodies);
  archive.same(solids_.obstacles().size());
  for (std::size_t i = 0; i < bodies; ++i) {
    transfer_motion(archive, solids_.body(i));
  }
  contacts_.transfer(archive, solids_.count(),
                     std::ranges::any_of(solids_.starts(), [](const BodyStart& body) {
                       return body.surface.resists_turning();
                     }));
  grips_.transfer(archive, bodies);
  sleep_.transfer(archive, bodies, solids_.count());
  for (std::size_t i = 0; archive.is_reading() && i < bodies; ++i) {
    if (sleep_.is_asleep(i)) {
      hulls_.place(solids_, i);
    }
  }
}

void WorldBodies::transfer(StateArchive& archive) {
  if (any()) {
    bodies_.transfer(archive);
  }
}

}  // namespace tactus::rendering
