// The box in which a simulated device of any lengths works: its middle and its end stops.
#pragma once

#include <optional>

#include "firmware/configuration/controller_config.h"
#include "host_tools/simulation/plant_mechanism.h"

namespace tactus::host {

// A box in the base frame B, m.
struct DeviceWorkspace {
  Vec3 centre_B = Vec3::Zero();
  Vec3 lower_B = Vec3::Zero();
  Vec3 upper_B = Vec3::Zero();
};

// Returns the joints' positions of a pose, rad or m.
Vec3 joints_at(const PlantMechanism& mechanism, const MechanismPose& pose);

// Returns where the controller believes a handle at `p_B` to be; nothing if the simulated mechanism
// does not reach there, is singular, or is beyond the joints' limits less `margin` (rad or m).
std::optional<firmware::Pose> controller_pose(const firmware::ControllerConfig& config,
                                              const PlantMechanism& mechanism, const Vec3& p_B,
                                              double margin = 0.0);

// Returns the same, and nothing where the controller sees the handle elsewhere than it is.
std::optional<firmware::Pose> rightly_seen_pose(const firmware::ControllerConfig& config,
                                                const PlantMechanism& mechanism, const Vec3& p_B,
                                                double margin = 0.0);

// Returns a box within the limits of the controller's joints, in which the controller sees the
// handle where it is. It has the middle and the shape of `like`, which is the workspace of a device
// of the same kind, scaled to these lengths, if there is room for half of that; else it lies where
// there is the most room. Nothing if there is no such place.
std::optional<DeviceWorkspace> find_workspace(const firmware::ControllerConfig& config,
                                              const PlantMechanism& mechanism,
                                              const DeviceWorkspace& like);

}  // namespace tactus::host
