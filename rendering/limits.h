// Every capacity of the rendering part in one place: what it bounds, and what happens beyond it.
// The sizes are those of the build's profile (rendering/profiles); all other limits are the same in
// every profile. firmware/limits.h adds the controller's own.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rendering/profiles/chosen_profile.h"

namespace tactus::rendering {

// Objects in a scene. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxObjects = kProfile.objects;

// Tools in one world, each with its own proxies. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxTools = kProfile.tools;

// Objects that move or deform, and objects that the shared proxy does not meet (contact methods
// other than sphere_proxy and god_object). Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxMovers = kProfile.movers;
inline constexpr std::size_t kMaxIndependentObjects = kProfile.independent_objects;

// Meshes of a scene that deform, their vertices and their hierarchy nodes. Beyond:
// World::set_scene refuses.
inline constexpr std::size_t kMaxDeformables = kProfile.deformables;
inline constexpr std::size_t kMaxDeformableVertices = kProfile.deformable_vertices;
inline constexpr std::size_t kMaxDeformableNodes = kProfile.deformable_nodes;

// The largest step of a vertex in one tick, m: 2 m/s at 1 kHz. Beyond: it takes several ticks.
inline constexpr double kMaxVertexStep_m = 2e-3;

// Vertices of a mesh that a scene's own waves move in one tick. Beyond: they take turns.
inline constexpr std::size_t kWaveVertices = 512;

// Boxes of a hierarchy that deforms drawn anew in one tick. Beyond: they wait, and searches reach
// farther meanwhile.
inline constexpr std::size_t kRefitNodes = 1024;

// Objects whose material or contact method is changed while the scene runs. Beyond:
// World::set_material and World::set_method refuse.
inline constexpr std::size_t kMaxChangedObjects = kProfile.changed_objects;

// Bodies that move by forces, and fixed objects that they meet. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxBodies = kProfile.bodies;
inline constexpr std::size_t kMaxObstacles = kProfile.obstacles;

// Contacts between bodies, each of up to four points. Beyond: the last ones in the order of the
// bodies' numbers are left out of a tick.
inline constexpr std::size_t kMaxBodyContacts = kProfile.body_contacts;

// Triangles of one mesh near one body. Beyond: those at the body's corners are met, and what lies
// under its faces is not.
inline constexpr std::size_t kMaxNearTriangles = kProfile.near_triangles;

// Places where one body touches one mesh, or one surface of a formula: each of up to four points,
// with a normal of its own. Beyond: those that are deepest and differ most in their normals stay.
inline constexpr std::size_t kMaxContactPatches = 4;

// Vertices of a convex hull, the collision shape of a body. Beyond: baking keeps those that leave
// out least.
inline constexpr std::size_t kMaxHullVertices = 64;

// Convex parts of one body, and of all bodies of a scene. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxPartsOfBody = kProfile.parts_of_body;
inline constexpr std::size_t kMaxBodyParts = kProfile.body_parts;

// Effects in a scene. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxEffects = kProfile.effects;

// Objects with tissue in a scene. Beyond: World::set_scene refuses.
inline constexpr std::size_t kMaxTissues = kProfile.tissues;

// Levels of a bounding-volume hierarchy; sizes every traversal stack. Beyond: baking balances, the
// image check refuses.
inline constexpr std::size_t kMaxHierarchyDepth = 64;

// Candidates: triangles near the tool that are cached from tick to tick (about 370 bytes each).
// Beyond: the candidate set shrinks, and if even the smallest does not fit, the proxy sweeps
// straight toward the tool or holds still; kTouchCandidatesOverflow.
inline constexpr std::size_t kMaxCandidates = kProfile.candidates;

// Distinct contact planes at one position of the proxy. Beyond: the proxy holds still, unless the
// straight segment to the tool is free; kTouchPlanesOverflow.
inline constexpr std::size_t kMaxContactPlanes = 24;

// Straight moves of the proxy in one tick. Beyond: it stops where it is, nearer to the tool than
// before, and goes on in the next tick; kTouchIterationsExhausted.
inline constexpr std::size_t kMaxSubGoals = 1024;

// Triangles that feature_walk measures in one tick of contact, and on the path to it, within the
// tick's budget. Beyond: the point stops where it is, nearer to the tool than before, and goes on
// in the next tick; kTouchIterationsExhausted.
inline constexpr std::size_t kMaxFeatureVisits = 2048;

// Texels along a side of a texture, and the levels that such a side needs. Beyond: the picture is
// refused, when it is baked and when it is opened.
inline constexpr std::uint32_t kMaxTextureSide = 8192;
inline constexpr std::size_t kMaxTextureLevels = 14;

// The instructions that a tick may take, per second of its period, unless World::set_tick_budget
// says otherwise: 2 million at 1 kHz, which a desktop core carries out in half of the period. All
// tools share them. Beyond: a proxy stops where it is and goes on in the next tick;
// kTouchIterationsExhausted. Ordinary touching takes a small part of them.
//
// Measurements are kept. A tick that finds the proxy where the last one began may exceed the budget
// up to its first move, so that no place can hold the proxy for ever.
inline constexpr double kTickInstructions_per_s = 2e9;
// The least budget that follows from a period: that of a loop of 8 kHz.
inline constexpr double kLeastTickInstructions = 250e3;

// The budget, in cost units (tick_budget.h), for carrying the proxy along with moving
// objects, where hundreds of triangles may come over it at 5 m/s; the tick's budget pays for it,
// and does not cut it. Beyond: they pass over it; kTouchPinched. The same budget bounds a straight
// sweep among more than kMaxCandidates. Beyond: the proxy moves no farther than the sweep has seen.
inline constexpr std::size_t kMaxCarryBudget = 12'288;

// Instructions of an implicit surface's formula; sizes the evaluation's stack frame, 16 kilobytes.
// Beyond: baking and the image check refuse.
inline constexpr std::size_t kMaxFormulaInstructions = 256;

// Formula instructions evaluated for one implicit surface in one tick, within the tick's budget:
// about 0.2 ms of a desktop core. Beyond: the proxy stops where its path is known to be free,
// nearer to the tool than before, and goes on in the next tick; kTouchIterationsExhausted.
inline constexpr std::size_t kMaxFormulaBudget = 32768;

// The world lies within this distance of its origin, metres. A tool beyond it is an error of the
// device; kTouchToolInvalid.
inline constexpr double kWorldBound_m = 100.0;

// The largest sphere that touches, metres. Beyond: the world and the loader refuse the scene.
inline constexpr double kMaxToolRadius_m = 1.0;
// Returns true if a sphere of this radius may touch; NaN may not.
constexpr bool is_tool_radius(double radius_m) {
  return radius_m >= 0.0 && radius_m <= kMaxToolRadius_m;
}

}  // namespace tactus::rendering
