#include "tests/ode/twin_worlds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace tactus::testing {

using rendering::kBodyTick_s;
using rendering::PrimitiveKind;
using rendering::RigidPose;

TwinWorlds::TwinWorlds(const Setting& setting)
    : setting_(setting), ode_(kBodyTick_s / setting.steps_in_tick, setting.sweeps) {
  bench_.world().set_gravity(setting.gravity_W);
  ode_.set_gravity(setting.gravity_W);
  ode_.set_surfaces({setting.friction_on_planes, setting.restitution},
                    {setting.friction_of_bodies, setting.restitution});
}

// BodyWorld takes the geometric mean of the coefficients of both surfaces.
void TwinWorlds::add_plane(const Vec3& normal_W) {
  const double on_planes = setting_.friction_on_planes;
  const double of_bodies = setting_.friction_of_bodies;
  ASSERT_TRUE(of_bodies > 0.0 || on_planes == 0.0);
  bench_.add_plane(normal_W, of_bodies > 0.0 ? on_planes * on_planes / of_bodies : 0.0);
  ode_.add_plane(normal_W);
}

void TwinWorlds::add(const OdeBody& body) {
  bench_.add(body.primitive, body.mass, body.X_WO,
             {.friction = setting_.friction_of_bodies, .restitution = setting_.restitution},
             body.velocity_W, body.angular_velocity_O);
  ode_.add_body(body);
}

Difference TwinWorlds::run(double seconds) {
  Difference most;
  const auto ticks = std::lround(seconds / kBodyTick_s);
  for (long tick = 0; tick < ticks; ++tick) {
    bench_.run(kBodyTick_s);
    for (int step = 0; step < setting_.steps_in_tick; ++step) {
      ode_.step();
    }
    const Difference now = difference();
    most = {.place_m = std::max(most.place_m, now.place_m),
            .turn_rad = std::max(most.turn_rad, now.turn_rad)};
  }
  return most;
}

// Two rotations that differ by the angle t differ as matrices by the norm sqrt(8) sin(t / 2).
Difference TwinWorlds::difference() const {
  Difference most;
  for (std::size_t i = 0; i < bench_.bodies(); ++i) {
    const RigidPose ours = bench_.body(i).pose();
    const RigidPose theirs = ode_.pose(i);
    const double apart = (ours.rotation - theirs.rotation).norm() / std::sqrt(8.0);
    most.place_m = std::max(most.place_m, (ours.translation - theirs.translation).norm());
    most.turn_rad = std::max(most.turn_rad, 2.0 * std::asin(std::min(apart, 1.0)));
  }
  return most;
}

void TwinWorlds::hold(std::size_t body, const Vec3& point_O, const TwinFinger& finger) {
  constexpr double kSticks = 100.0;
  const Vec3 point = bench_.body(body).pose().point(point_O);
  const std::array grips{
      rendering::FingerGrip{.body = static_cast<std::uint32_t>(body),
                            .point_W = point,
                            .normal_W = finger.normal_W,
                            .spring_force_W = finger.stiffness_N_per_m * (point - finger.tool_W),
                            .stiffness_N_per_m = finger.stiffness_N_per_m,
                            .damping_Ns_per_m = finger.damping_Ns_per_m,
                            .friction = kSticks,
                            .tool_v_W = finger.tool_v_W}};
  std::array<Vec3, 1> forces;
  bench_.world().step(kBodyTick_s, grips, forces);
  for (int step = 0; step < setting_.steps_in_tick; ++step) {
    const double now_s = kBodyTick_s * step / setting_.steps_in_tick;
    const Vec3 held = ode_.pose(body).point(point_O);
    const Vec3 tool = finger.tool_W + now_s * finger.tool_v_W;
    const Vec3 slip = finger.tool_v_W - ode_.velocity_at(body, held);
    ode_.push(body, finger.stiffness_N_per_m * (tool - held) + finger.damping_Ns_per_m * slip,
              held);
    ode_.step();
  }
}

void print_difference(std::string_view scene, double seconds, const Difference& difference) {
  std::printf("| %-52s | %4.2f | %7.3f | %7.2f |\n", std::string(scene).c_str(), seconds,
              1e3 * difference.place_m, 1e3 * difference.turn_rad);
}

void expect_alike(std::string_view scene, TwinWorlds& worlds, double seconds,
                  const Difference& limit) {
  const Difference found = worlds.run(seconds);
  print_difference(scene, seconds, found);
  EXPECT_LE(found.place_m, limit.place_m) << scene;
  EXPECT_LE(found.turn_rad, limit.turn_rad) << scene;
}

double ahead_m(double acceleration_m_per_s2, double seconds) {
  constexpr double kStep_s = kBodyTick_s / 4.0;
  constexpr double kOdeStep_s = kBodyTick_s / 50.0;
  return 0.5 * (kStep_s - kOdeStep_s) * acceleration_m_per_s2 * seconds;
}

OdeBody box_body(const Vec3& half_m, double mass_kg, const RigidPose& pose, const Vec3& velocity_W,
                 const Vec3& turn_O) {
  return {.primitive = {.kind = PrimitiveKind::box,
                        .dimensions_m = {half_m.x(), half_m.y(), half_m.z()}},
          .mass = rendering::mass_of_box(mass_kg, half_m),
          .X_WO = pose,
          .velocity_W = velocity_W,
          .angular_velocity_O = turn_O};
}

OdeBody ball_body(double radius_m, double mass_kg, const Vec3& center_W, const Vec3& velocity_W) {
  return {.primitive = {.kind = PrimitiveKind::sphere, .dimensions_m = {radius_m}},
          .mass = rendering::mass_of_ball(mass_kg, radius_m),
          .X_WO = {.translation = center_W},
          .velocity_W = velocity_W};
}

OdeBody round_body(PrimitiveKind kind, double radius_m, double half_m, double mass_kg,
                   const RigidPose& pose) {
  const double across = mass_kg * (radius_m * radius_m / 4.0 + half_m * half_m / 3.0);
  const double along = 0.5 * mass_kg * radius_m * radius_m;
  return {.primitive = {.kind = kind, .dimensions_m = {radius_m, half_m}},
          .mass = {.mass_kg = mass_kg, .inertia_C = Vec3(across, along, across).asDiagonal()},
          .X_WO = pose};
}

}  // namespace tactus::testing
