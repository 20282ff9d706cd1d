// Where the energy that the hand gets from the device comes from, by name.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// Whose force it is, or, of coupling and delay, whose energy.
enum class EnergySource : std::uint8_t {
  contact,   // surfaces: what holds the tool out, along the normal, and their damping
  friction,  // what holds it back along the surface
  texture,   // what bumps and shading change of that
  effect,    // fields, springs and signals without a surface
  coupling,  // objects that move by themselves, through the surface that pushes the tool
  safety,    // the controller's own: workspace walls, passivity damping, what limits change
  delay,     // what a force that is held for a tick gives more than one that follows at once
};
inline constexpr std::size_t kEnergySourceCount = 7;
inline constexpr std::array<std::string_view, kEnergySourceCount> kEnergySourceNames = {
    "contact", "friction", "texture", "effect", "coupling", "safety", "delay"};

// J to the hand since activation, by source; negative where the hand has given it.
using EnergyLedger = std::array<double, kEnergySourceCount>;

}  // namespace tactus::firmware
