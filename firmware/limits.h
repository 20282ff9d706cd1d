// The fixed sizes and bounds of the controller, in one place. Each comment says what happens at the
// bound. A change of a size changes the static memory of the program; a change of a range changes
// which configurations validate() accepts.
#pragma once

#include <cstddef>

#include "rendering/profiles/chosen_profile.h"

namespace tactus::firmware {

// The largest size of the Controller of one device with its World, without the scene image, in the
// build's profile (rendering/profiles). A static_assert in control/controller.cpp checks it.
inline constexpr std::size_t kMaxControllerBytes = rendering::kProfile.controller_bytes;

// The most bytes that Controller::save writes for one tool: as many moving objects, vertices and
// nodes of deforming ones, triangles near the tool and proxies of single objects as the profile has
// room for. A test saves such a scene. If a state is larger, save() returns 0.
inline constexpr std::size_t kMaxCheckpointBytes = rendering::kProfile.checkpoint_bytes;

// The number of ticks in the flight recorder (firmware/linux/flight), a power of two. At least five
// eighths of them can be replayed: with 16,384 of them 10 s at 1 kHz, 1.3 s at 8 kHz. Older ticks
// are overwritten.
inline constexpr std::size_t kFlightTicks = rendering::kProfile.flight_ticks;

// The largest number of joints of a mechanism. Further joints of a sample are neither read nor
// recorded, and get no effort.
inline constexpr std::size_t kJointCount = 3;

// The largest number of stops between two links in a configuration.
inline constexpr std::size_t kMaxCoupledLimits = 2;

// The most Newton steps of the delta's forward kinematics. Two or three are enough from the pose of
// the previous tick, seven from the nominal pose to every pose of the Falcon. After more steps the
// fault is kFaultKinematicsNotConverged.
inline constexpr int kMaxNewtonSteps = 24;

// The range of loop rates that configure() accepts.
inline constexpr double kMinRate_Hz = 50.0;
inline constexpr double kMaxRate_Hz = 50'000.0;

// The largest force that a configuration may allow. Above it a desktop device can hurt a wrist.
inline constexpr double kMaxForce_N = 50.0;

// The largest share of a joint's friction that a configuration may compensate. The rest is the
// margin for errors of the fit.
inline constexpr double kMaxCompensatedShare = 0.9;

}  // namespace tactus::firmware
