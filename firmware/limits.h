// Every fixed size and bound of the controller, with what happens at it.
#pragma once

#include <cstddef>

namespace tactus::firmware {

// The Controller with its World, without the scene's image. Checked when control/controller.cpp
// compiles.
inline constexpr std::size_t kMaxControllerBytes = std::size_t{4} << 20;

// What Controller::save writes at the most for one tool: of 64 objects that move, the vertices and
// nodes of those that deform, 512 triangles near the tool and 64 proxies of single objects. A test
// saves such a scene. Beyond, with more tools: save() says no.
inline constexpr std::size_t kMaxCheckpointBytes = std::size_t{512} << 10;

// Ticks that the flight recorder holds (firmware/flight); a power of two. At least five eighths of
// them can be replayed: 10 s at 1 kHz, 1.3 s at 8 kHz. Beyond: the oldest are gone.
inline constexpr std::size_t kFlightTicks = 16384;

// Joints that the mechanisms of this folder have at most. A sample's joints beyond those of the
// mechanism are neither read nor recorded, and have no effort.
inline constexpr std::size_t kJointCount = 3;

// Stops between two links that a configuration may have.
inline constexpr std::size_t kMaxCoupledLimits = 2;

inline constexpr double kStandardGravity_m_per_s2 = 9.80665;

// Newton steps of the delta's forward kinematics. From the pose of the tick before two or three are
// enough; from the nominal pose seven reach every pose of the Falcon. Beyond:
// kFaultKinematicsNotConverged.
inline constexpr int kMaxNewtonSteps = 24;

// Loop rates that configure() accepts, Hz.
inline constexpr double kMinRate_Hz = 50.0;
inline constexpr double kMaxRate_Hz = 50'000.0;

// The strongest force that a configuration may allow, N: above it a desktop device can hurt a
// wrist.
inline constexpr double kMaxForce_N = 50.0;

// The largest share of a joint's friction that a configuration may have compensated: what is left
// is the room for a fit that is wrong.
inline constexpr double kMaxCompensatedShare = 0.9;

}  // namespace tactus::firmware
