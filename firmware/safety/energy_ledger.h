// The sources of the energy that the device gives to the hand, with their names. Constants and
// plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// The sources. All but coupling and delay are sources of a force; those two are sources of energy
// only.
enum class EnergySource : std::uint8_t {
  contact,   // stiffness and damping of surfaces, along the normal
  friction,  // friction, along the surface
  texture,   // the change that bumps and force shading make to contact and friction
  effect,    // fields, springs and signals without a surface
  coupling,  // objects that move by themselves and push the tool with their surface
  safety,    // the controller's own force: workspace walls, passivity damping, effect of limits
  delay,     // the energy that a force held for a tick gives beyond one that follows at once
};
// The number of sources, and their names in the order of EnergySource.
inline constexpr std::size_t kEnergySourceCount = 7;
inline constexpr std::array<std::string_view, kEnergySourceCount> kEnergySourceNames = {
    "contact", "friction", "texture", "effect", "coupling", "safety", "delay"};

// The energy given to the hand since activation, J, by source. It is negative if the hand gave it.
using EnergyLedger = std::array<double, kEnergySourceCount>;

}  // namespace tactus::firmware
