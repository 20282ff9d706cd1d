// Every capacity of the rendering part in one place: what it bounds, and what happens beyond it.
// firmware/limits.h adds the controller's own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus::rendering {

// Objects in a scene. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxObjects = 64;

// Levels of a bounding-volume hierarchy; sizes every traversal stack. Beyond: baking balances, the
// image check refuses.
inline constexpr std::size_t kMaxHierarchyDepth = 64;

// Triangles near the tool that are kept from tick to tick (about 350 bytes each). Beyond: the
// neighbourhood shrinks, and if even the smallest does not fit, the proxy holds still;
// kTouchCandidatesOverflow.
inline constexpr std::size_t kMaxCandidates = 1024;

// Distinct contact planes at one position of the proxy. Beyond: the proxy holds still;
// kTouchPlanesOverflow.
inline constexpr std::size_t kMaxContactPlanes = 24;

// Straight moves of the proxy in one tick. Beyond: it stops where it is, nearer to the tool than
// before, and goes on in the next tick; kTouchIterationsExhausted.
inline constexpr std::size_t kMaxSubGoals = 64;

// Texels along a side of a texture, and the levels that such a side needs. Beyond: the picture is
// refused, when it is baked and when it is opened.
inline constexpr std::uint32_t kMaxTextureSide = 8192;
inline constexpr std::size_t kMaxTextureLevels = 14;

// The world lies within this distance of its origin, metres. A tool beyond it is an error of the
// device; kTouchToolInvalid.
inline constexpr double kWorldBound_m = 100.0;

}  // namespace tactus::rendering
