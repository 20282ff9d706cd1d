// A world of bodies that the Open Dynamics Engine computes, in double precision.
#pragma once

#include <cstddef>
#include <vector>

#include <ode/ode.h>

#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"
#include "rendering/objects/object_body.h"
#include "rendering/surface/primitive.h"

namespace tactus::testing {

// The surfaces of all contacts of a body with a plane, or of two bodies.
struct OdeSurface {
  // The coefficients of Coulomb's friction and of restitution.
  double friction = 0.0;
  double restitution = 0.0;
};

// A body: a sphere, a capsule, a box or a cylinder about its centre of mass.
struct OdeBody {
  rendering::Primitive primitive;
  rendering::BodyMass mass;
  rendering::RigidPose X_WO;
  Vec3 velocity_W = Vec3::Zero();
  Vec3 angular_velocity_O = Vec3::Zero();
};

// Friction is a pyramid in ODE: here it lies along the slip of each contact and has no width across
// it, so that it is the cone of Coulomb. It is wrong in a hit that turns the slip.
class OdeWorld {
 public:
  // A world without gravity, planes and bodies, whose steps last so long. Without sweeps every step
  // solves the contacts exactly (dWorldStep), but limits friction by the normal forces that there
  // would be without it; else the sweeps follow these forces as they change (dWorldQuickStep).
  OdeWorld(double step_s, int sweeps);
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  void set_gravity(const Vec3& gravity_W);
  // Adds the half space below a plane through the origin.
  void add_plane(const Vec3& normal_W);
  void add_body(const OdeBody& start);
  // Sets the surfaces of the contacts with planes, and of those of two bodies.
  void set_surfaces(const OdeSurface& with_planes, const OdeSurface& of_bodies);

  // Adds a force at a point of a body for the next step, N and m.
  void push(std::size_t body, const Vec3& force_W, const Vec3& point_W);
  // Computes one step.
  void step();

  [[nodiscard]] rendering::RigidPose pose(std::size_t body) const;
  // Returns the velocity of the body's point at `point_W`, m/s.
  [[nodiscard]] Vec3 velocity_at(std::size_t body, const Vec3& point_W) const;

 private:
  static void meet(void* world, dGeomID a, dGeomID b);
  // Adds the contacts of two geometries to the next step.
  void add_contacts(dGeomID a, dGeomID b);
  void add_contact(const dContactGeom& found);

  double step_s_;
  int sweeps_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;
  OdeSurface with_planes_;
  OdeSurface of_bodies_;
};

}  // namespace tactus::testing
