#include "firmware/control/material_changes.h"

#include <algorithm>
#include <cmath>

namespace tactus::firmware {
namespace {

using rendering::Material;

// Returns the largest change of force between two materials, N: of spring, damper and friction,
// which is a share of the spring's force.
double force_between(const Material& a, const Material& b, double stretch_m, double speed_m_per_s) {
  // Friction is a share of the spring's force, so the larger stiffness bounds it.
  const double stiffness = std::max(a.stiffness_N_per_m, b.stiffness_N_per_m);
  const double friction =
      std::max(std::abs(a.friction.static_level - b.friction.static_level),
               std::abs(a.friction.coulomb - b.friction.coulomb)) +
      std::abs(a.friction.viscous_s_per_m - b.friction.viscous_s_per_m) * speed_m_per_s;
  return std::abs(a.stiffness_N_per_m - b.stiffness_N_per_m) * stretch_m +
         std::abs(a.damping_Ns_per_m - b.damping_Ns_per_m) * speed_m_per_s +
         friction * stiffness * stretch_m;
}

// Moves a value by a share of its distance to the wanted one.
void go_on(double& value, double wanted, double share) {
  value += share * (wanted - value);
}

// Interpolates between two materials. If both ends are valid, so is the result.
Material between(const Material& from, const Material& wanted, double share) {
  Material now = from;
  go_on(now.stiffness_N_per_m, wanted.stiffness_N_per_m, share);
  go_on(now.damping_Ns_per_m, wanted.damping_Ns_per_m, share);
  go_on(now.friction.static_level, wanted.friction.static_level, share);
  go_on(now.friction.coulomb, wanted.friction.coulomb, share);
  go_on(now.friction.viscous_s_per_m, wanted.friction.viscous_s_per_m, share);
  return now;
}

}  // namespace

void MaterialChanges::set(std::uint32_t object, const Material& wanted) {
  std::size_t i = 0;
  while (i < count_ && changes_[i].object != object) {
    ++i;
  }
  if (i == changes_.size()) {
    return;  // the world has room for no more changed materials either
  }
  count_ = std::max(count_, i + 1);
  changes_[i] = {.object = object, .wanted = wanted};
}

// The order of the changes does not matter.
void MaterialChanges::forget(std::uint32_t object) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (changes_[i].object == object) {
      changes_[i] = changes_[--count_];
      return;
    }
  }
}

Material MaterialChanges::wanted(const rendering::World& world, std::uint32_t object) const {
  for (std::size_t i = 0; i < count_; ++i) {
    if (changes_[i].object == object) {
      return changes_[i].wanted;
    }
  }
  return world.material(object);
}

void MaterialChanges::step(rendering::World& world, double most_N, double speed_m_per_s) {
  // Each object gets an equal part of the step, because several may be touched at once.
  const double each_N = most_N / static_cast<double>(std::max<std::size_t>(count_, 1));
  for (std::size_t i = 0; i < count_;) {
    const auto& [object, wanted] = changes_[i];
    const Material& now = world.material(object);
    const double force_N = force_between(now, wanted, world.stretch_m(object), speed_m_per_s);
    if (force_N > each_N) {
      world.set_material(object, between(now, wanted, each_N / force_N));
      ++i;
      continue;
    }
    world.set_material(object, wanted);
    // The order of the changes does not matter.
    changes_[i] = changes_[--count_];
  }
}

void MaterialChanges::finish(rendering::World& world) {
  for (std::size_t i = 0; i < count_; ++i) {
    world.set_material(changes_[i].object, changes_[i].wanted);
  }
  clear();
}

void MaterialChanges::transfer(rendering::StateArchive& archive, const rendering::World& world) {
  archive.up_to(count_, changes_.size());
  for (std::size_t i = 0; i < count_ && archive.good(); ++i) {
    auto& [object, wanted] = changes_[i];
    archive(object);
    archive.require(object < world.object_count());
    if (!archive.good()) {
      break;
    }
    if (archive.is_reading()) {
      wanted = world.material(object);
    }
    archive(wanted.stiffness_N_per_m, wanted.damping_Ns_per_m, wanted.friction.static_level,
            wanted.friction.coulomb, wanted.friction.viscous_s_per_m);
    archive.require(rendering::sound(wanted));
  }
  if (archive.is_reading() && !archive.good()) {
    clear();
  }
}

}  // namespace tactus::firmware
