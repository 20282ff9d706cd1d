#include "tests/ode/ode_world.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace tactus::testing {
namespace {

using rendering::RigidPose;

// The rate with which overlaps are undone, 1/s, and the fastest recovery, m/s. Both are small: the
// recovery of ODE gives energy to the bodies.
constexpr double kRecovery_per_s = 50.0;
constexpr double kFastestRecovery_m_per_s = 1e-3;
// The constraints yield by so much, m/(s N): next to nothing.
constexpr double kYield = 1e-10;
// Contacts that slip faster have their friction along the slip alone, m/s.
constexpr double kSlip_m_per_s = 1e-3;
// Slower approaches do not bounce, m/s, as in BodyWorld.
constexpr double kLeastBounce_m_per_s = 0.05;

// ODE counts how often it has been started, and needs it once.
struct OdeLibrary {
  OdeLibrary() { dInitODE2(0); }
  ~OdeLibrary() { dCloseODE(); }
  OdeLibrary(const OdeLibrary&) = delete;
  OdeLibrary& operator=(const OdeLibrary&) = delete;
};

Vec3 vector_of(const dReal* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

// The rows of ODE's matrices have four numbers.
void to_ode(const Mat3& rotation, dMatrix3& out) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      out[4 * row + column] = rotation(row, column);
    }
    out[4 * row + 3] = 0.0;
  }
}

// The axis of a capsule and of a cylinder is y here, and z in ODE.
dGeomID shape_of(dSpaceID space, const rendering::Primitive& primitive) {
  const auto& size = primitive.dimensions_m;
  switch (primitive.kind) {
    case rendering::PrimitiveKind::sphere:
      return dCreateSphere(space, size[0]);
    case rendering::PrimitiveKind::capsule:
      return dCreateCapsule(space, size[0], 2.0 * size[1]);
    case rendering::PrimitiveKind::cylinder:
      return dCreateCylinder(space, size[0], 2.0 * size[1]);
    default:
      return dCreateBox(space, 2.0 * size[0], 2.0 * size[1], 2.0 * size[2]);
  }
}

bool has_axis(rendering::PrimitiveKind kind) {
  return kind == rendering::PrimitiveKind::capsule || kind == rendering::PrimitiveKind::cylinder;
}

Vec3 velocity_of(dBodyID body, const Vec3& point_W) {
  if (body == nullptr) {
    return Vec3::Zero();
  }
  dVector3 velocity;
  dBodyGetPointVel(body, point_W.x(), point_W.y(), point_W.z(), velocity);
  return vector_of(velocity);
}

}  // namespace

OdeWorld::OdeWorld(double step_s, int sweeps) : step_s_(step_s), sweeps_(sweeps) {
  static const OdeLibrary library;
  EXPECT_EQ(dCheckConfiguration("ODE_double_precision"), 1);
  world_ = dWorldCreate();
  space_ = dSimpleSpaceCreate(nullptr);
  contacts_ = dJointGroupCreate(0);
  dWorldSetERP(world_, kRecovery_per_s * step_s);
  dWorldSetCFM(world_, kYield);
  dWorldSetQuickStepNumIterations(world_, sweeps);
  dWorldSetQuickStepW(world_, 1.0);
  dWorldSetContactMaxCorrectingVel(world_, kFastestRecovery_m_per_s);
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(contacts_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

void OdeWorld::set_gravity(const Vec3& gravity_W) {
  dWorldSetGravity(world_, gravity_W.x(), gravity_W.y(), gravity_W.z());
}

void OdeWorld::add_plane(const Vec3& normal_W) {
  dCreatePlane(space_, normal_W.x(), normal_W.y(), normal_W.z(), 0.0);
}

void OdeWorld::set_surfaces(const OdeSurface& with_planes, const OdeSurface& of_bodies) {
  with_planes_ = with_planes;
  of_bodies_ = of_bodies;
}

void OdeWorld::add_body(const OdeBody& start) {
  const dBodyID body = dBodyCreate(world_);
  const Mat3& inertia = start.mass.inertia_C;
  dMass mass;
  dMassSetParameters(&mass, start.mass.mass_kg, 0.0, 0.0, 0.0, inertia(0, 0), inertia(1, 1),
                     inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2));
  dBodySetMass(body, &mass);
  const dGeomID shape = shape_of(space_, start.primitive);
  dGeomSetBody(shape, body);
  if (has_axis(start.primitive.kind)) {
    dMatrix3 upright;
    to_ode(Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix(), upright);
    dGeomSetOffsetRotation(shape, upright);
  }
  const RigidPose& pose = start.X_WO;
  dMatrix3 rotation;
  to_ode(pose.rotation, rotation);
  dBodySetRotation(body, rotation);
  dBodySetPosition(body, pose.translation.x(), pose.translation.y(), pose.translation.z());
  dBodySetLinearVel(body, start.velocity_W.x(), start.velocity_W.y(), start.velocity_W.z());
  const Vec3 turn_W = pose.rotation * start.angular_velocity_O;
  dBodySetAngularVel(body, turn_W.x(), turn_W.y(), turn_W.z());
  dBodySetAutoDisableFlag(body, 0);
  bodies_.push_back(body);
}

void OdeWorld::push(std::size_t body, const Vec3& force_W, const Vec3& point_W) {
  dBodyAddForceAtPos(bodies_[body], force_W.x(), force_W.y(), force_W.z(), point_W.x(), point_W.y(),
                     point_W.z());
}

void OdeWorld::step() {
  dSpaceCollide(space_, this, &OdeWorld::meet);
  if (sweeps_ > 0) {
    dWorldQuickStep(world_, step_s_);
  } else {
    dWorldStep(world_, step_s_);
  }
  dJointGroupEmpty(contacts_);
}

void OdeWorld::meet(void* world, dGeomID a, dGeomID b) {
  static_cast<OdeWorld*>(world)->add_contacts(a, b);
}

void OdeWorld::add_contacts(dGeomID a, dGeomID b) {
  std::array<dContactGeom, 8> found;
  const int count =
      dCollide(a, b, static_cast<int>(found.size()), found.data(), sizeof(dContactGeom));
  for (int i = 0; i < count; ++i) {
    add_contact(found[static_cast<std::size_t>(i)]);
  }
}

void OdeWorld::add_contact(const dContactGeom& found) {
  const dBodyID a = dGeomGetBody(found.g1);
  const dBodyID b = dGeomGetBody(found.g2);
  const OdeSurface& surface = a != nullptr && b != nullptr ? of_bodies_ : with_planes_;
  dContact contact{};
  contact.geom = found;
  contact.surface.mode = dContactApprox1 | dContactFDir1 | dContactMu2;
  contact.surface.mu = surface.friction;
  contact.surface.mu2 = surface.friction;
  if (surface.restitution > 0.0) {
    contact.surface.mode |= dContactBounce;
    contact.surface.bounce = surface.restitution;
    contact.surface.bounce_vel = kLeastBounce_m_per_s;
  }
  const Vec3 normal = vector_of(found.normal);
  const Vec3 point = vector_of(found.pos);
  const Vec3 motion = velocity_of(a, point) - velocity_of(b, point);
  const Vec3 slip = motion - motion.dot(normal) * normal;
  Vec3 along = normal.unitOrthogonal();
  if (slip.norm() > kSlip_m_per_s) {
    contact.surface.mu2 = 0.0;
    along = slip.normalized();
  }
  contact.fdir1[0] = along.x();
  contact.fdir1[1] = along.y();
  contact.fdir1[2] = along.z();
  dJointAttach(dJointCreateContact(world_, contacts_, &contact), a, b);
}

RigidPose OdeWorld::pose(std::size_t body) const {
  const dReal* const rows = dBodyGetRotation(bodies_[body]);
  RigidPose pose{.translation = vector_of(dBodyGetPosition(bodies_[body]))};
  pose.rotation << rows[0], rows[1], rows[2], rows[4], rows[5], rows[6], rows[8], rows[9], rows[10];
  return pose;
}

Vec3 OdeWorld::velocity_at(std::size_t body, const Vec3& point_W) const {
  return velocity_of(bodies_[body], point_W);
}

}  // namespace tactus::testing
