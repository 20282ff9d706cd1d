#include "host_tools/simulation/plant_mechanism.h"

#include <cmath>
#include <numbers>

#include "host_tools/simulation/linkages.h"
#include "host_tools/simulation/overloaded.h"

namespace tactus::host {
std::size_t joints_of(const PlantMechanism& mechanism) {
  return std::visit(Overloaded{[](const PaddleLengths&) -> std::size_t { return 1; },
                               [](const PantographLengths&) -> std::size_t { return 2; },
                               [](const auto&) -> std::size_t { return 3; }},
                    mechanism);
}

void solve_mechanism(const PlantMechanism& mechanism, const Vec3& p_B, MechanismPose& pose) {
  pose.reachable = true;
  std::visit(
      Overloaded{[&](const CartesianAxes&) { pose.coordinate = {p_B.x(), p_B.y(), p_B.z()}; },
                 [&](const DeltaLengths& own) { solve_delta(own, p_B, pose); },
                 [&](const PaddleLengths& own) { solve_paddle(own, p_B, pose); },
                 [&](const PantographLengths& own) { solve_pantograph(own, p_B, pose); },
                 [&](const ArmLengths& own) { solve_serial_arm(own, p_B, pose); }},
      mechanism);
}

double joint_position(const PlantMechanism& mechanism, std::size_t joint, double coordinate) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  if (std::holds_alternative<CartesianAxes>(mechanism)) {
    return coordinate;
  }
  if (joint >= joints_of(mechanism)) {
    return 0.0;
  }
  const double angle = 2.0 * std::atan(coordinate);
  return std::visit(
      Overloaded{[&](const PantographLengths&) { return kQuarter + angle; },
                 [&](const ArmLengths&) { return joint == 2 ? kQuarter + angle : angle; },
                 [&](const auto&) { return angle; }},
      mechanism);
}

Vec3 on_manifold(const PlantMechanism& mechanism, const Vec3& p_B) {
  if (std::holds_alternative<PantographLengths>(mechanism)) {
    return {p_B.x(), 0.0, p_B.z()};
  }
  if (const auto* const paddle = std::get_if<PaddleLengths>(&mechanism)) {
    const double radius = std::sqrt(p_B.x() * p_B.x() + p_B.y() * p_B.y());
    return radius > 0.0 ? Vec3(Vec3(p_B.x(), p_B.y(), 0.0) * (paddle->radius_m / radius))
                        : Vec3(0.0, paddle->radius_m, 0.0);
  }
  return p_B;
}

Vec3 along_manifold(const PlantMechanism& mechanism, const Vec3& p_B, const Vec3& v_B) {
  if (std::holds_alternative<PantographLengths>(mechanism)) {
    return {v_B.x(), 0.0, v_B.z()};
  }
  if (const auto* const paddle = std::get_if<PaddleLengths>(&mechanism)) {
    const Vec3 along = Vec3(p_B.y(), -p_B.x(), 0.0) / paddle->radius_m;
    return along.dot(v_B) * along;
  }
  return v_B;
}

Vec3 elbow_sum(const PlantMechanism& mechanism, const MechanismPose& pose) {
  return std::visit(
      Overloaded{[&](const CartesianAxes& axes) -> Vec3 {
                   return {axes.carried_kg[0] * pose.coordinate[0],
                           axes.carried_kg[1] * pose.coordinate[1],
                           axes.carried_kg[2] * pose.coordinate[2]};
                 },
                 [&](const DeltaLengths& own) { return delta_elbow_sum(own, pose); },
                 [](const PaddleLengths&) -> Vec3 { return Vec3::Zero(); },
                 [&](const PantographLengths& own) { return pantograph_elbow_sum(own, pose); },
                 [&](const ArmLengths& own) { return serial_arm_elbow(own, pose); }},
      mechanism);
}

Vec3 elbow_pull(const PlantMechanism& mechanism, const MechanismPose& pose, const Vec3& gravity_B) {
  return std::visit(
      Overloaded{
          [&](const CartesianAxes& axes) -> Vec3 {
            return {axes.carried_kg[0] * gravity_B.x(), axes.carried_kg[1] * gravity_B.y(),
                    axes.carried_kg[2] * gravity_B.z()};
          },
          [&](const DeltaLengths& own) { return delta_elbow_pull(own, pose, gravity_B); },
          [](const PaddleLengths&) -> Vec3 { return Vec3::Zero(); },
          [&](const PantographLengths& own) { return pantograph_elbow_pull(own, pose, gravity_B); },
          [&](const ArmLengths& own) { return serial_arm_elbow_pull(own, pose, gravity_B); }},
      mechanism);
}

}  // namespace tactus::host
