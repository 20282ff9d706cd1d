// The dimensions and weights of a device file's [mechanism] in the simulation's own terms. Numbers
// alone are taken over: the simulation solves them by itself (linkages.h).
#pragma once

#include "firmware/kinematics/mechanism.h"
#include "host_tools/simulation/plant_mechanism.h"

namespace tactus::host {

// A mechanism's weights as masses at the elbows and at the handle (PlantParameters).
struct PlantWeights {
  // The mass at each elbow, kg.
  double elbow_kg = 0.0;
  // The mass at the handle, kg.
  double handle_kg = 0.0;

  bool operator==(const PlantWeights&) const = default;
};

// Returns the mechanism with the dimensions of the geometry. Throws InputError for a mechanism that
// the simulation does not have.
PlantMechanism plant_mechanism(const firmware::MechanismGeometry& geometry);

// Returns the weights of the geometry. Each link's mass is divided over its two ends so that its
// centre of mass stays in place.
PlantWeights plant_weights(const firmware::MechanismGeometry& geometry);

// Returns the weights' inertia at a handle in this pose, kg: the mean over the directions in which
// the handle can move.
double weights_at_handle_kg(const PlantMechanism& mechanism, const PlantWeights& weights,
                            const MechanismPose& pose);

// Returns the length by which mechanisms of one kind are compared, m: the links one behind the
// other. 1 for a Cartesian device.
double whole_length_m(const PlantMechanism& mechanism);

}  // namespace tactus::host
