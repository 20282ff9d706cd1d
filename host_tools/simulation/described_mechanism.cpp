#include "host_tools/simulation/described_mechanism.h"

#include "host_tools/input_error.h"
#include "host_tools/simulation/linkages.h"
#include "host_tools/simulation/overloaded.h"

namespace tactus::host {
namespace {

// Returns the share of a link's mass that counts at its outer end.
double outer_share(const firmware::LinkWeight& weight, double length_m) {
  return weight.centre_m / length_m;
}

DeltaLengths delta_lengths(const firmware::DeltaGeometry& g) {
  DeltaLengths lengths{.arm_m = g.arm_m,
                       .rod_m = g.rod_m,
                       .end_pieces_m = g.hinge_offset_m,
                       .platform_m = g.platform_radius_m,
                       .platform_across_m = g.platform_tangent_m,
                       .base_m = g.base_radius_m,
                       .base_across_m = g.base_tangent_m,
                       .legs = {}};
  for (std::size_t i = 0; i < kPlantJoints; ++i) {
    const rendering::SineCosine azimuth = rendering::sine_cosine(g.azimuth_rad[i]);
    lengths.legs[i] = {.cos = azimuth.cosine, .sin = azimuth.sine};
  }
  return lengths;
}

// Returns the masses of two links in a row, `count` times, of which the outer ones meet at the
// handle.
PlantWeights weights_of_links(const firmware::LinkWeight& inner, double inner_m,
                              const firmware::LinkWeight& outer, double outer_m, double count) {
  const double share = outer_share(outer, outer_m);
  return {.elbow_kg = inner.mass_kg * outer_share(inner, inner_m) + outer.mass_kg * (1.0 - share),
          .handle_kg = count * (outer.mass_kg * share)};
}

}  // namespace

PlantMechanism plant_mechanism(const firmware::MechanismGeometry& geometry) {
  return std::visit(
      Overloaded{
          [](const firmware::CartesianGeometry& g) -> PlantMechanism {
            return CartesianAxes{.carried_kg = g.carried_kg};
          },
          [](const firmware::DeltaGeometry& g) -> PlantMechanism { return delta_lengths(g); },
          [](const firmware::PaddleGeometry& g) -> PlantMechanism {
            return PaddleLengths{.radius_m = g.handle_radius_m};
          },
          [](const firmware::PantographGeometry& g) -> PlantMechanism {
            return PantographLengths{
                .base_m = g.base_m, .proximal_m = g.proximal_m, .distal_m = g.distal_m};
          },
          [](const firmware::SerialArmGeometry& g) -> PlantMechanism {
            return ArmLengths{
                .upper_m = g.upper_m, .forearm_m = g.forearm_m, .shoulder_m = g.shoulder_height_m};
          },
          [](const auto&) -> PlantMechanism {
            throw InputError("[mechanism]: the simulation has no such mechanism");
          }},
      geometry);
}

PlantWeights plant_weights(const firmware::MechanismGeometry& geometry) {
  return std::visit(
      Overloaded{
          [](const firmware::CartesianGeometry& g) -> PlantWeights {
            return {.elbow_kg = has_weight(g) ? 1.0 : 0.0, .handle_kg = 0.0};
          },
          [](const firmware::DeltaGeometry& g) -> PlantWeights {
            return {.elbow_kg = g.arm.mass_kg * outer_share(g.arm, g.arm_m) + 0.5 * g.rods_kg,
                    .handle_kg = 1.5 * g.rods_kg + g.platform_kg};
          },
          [](const firmware::PaddleGeometry& g) -> PlantWeights {
            return {.elbow_kg = 0.0,
                    .handle_kg = g.paddle.mass_kg * outer_share(g.paddle, g.handle_radius_m)};
          },
          [](const firmware::PantographGeometry& g) -> PlantWeights {
            PlantWeights weights =
                weights_of_links(g.proximal, g.proximal_m, g.distal, g.distal_m, 2.0);
            weights.handle_kg += g.tool_kg;
            return weights;
          },
          [](const firmware::SerialArmGeometry& g) -> PlantWeights {
            PlantWeights weights =
                weights_of_links(g.upper, g.upper_m, g.forearm, g.forearm_m, 1.0);
            weights.handle_kg += g.tool_kg;
            return weights;
          },
          [](const auto&) -> PlantWeights { return {}; }},
      geometry);
}

// A mass at an elbow has the velocity J v of the elbow, and so the energy v^T (m J^T J) v / 2; the
// mean of the inertia is its trace over the number of directions. A crank's elbow has J = length
// row^T, and the elbow of a serial arm moves with the azimuth and the upper arm.
double weights_at_handle_kg(const PlantMechanism& mechanism, const PlantWeights& weights,
                            const MechanismPose& pose) {
  const auto cranks = [&](double length_m, std::size_t count) {
    double trace = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      trace += length_m * length_m * pose.rows[i].squaredNorm();
    }
    return trace;
  };
  const double trace =
      std::visit(Overloaded{[](const CartesianAxes& axes) {
                              return axes.carried_kg[0] + axes.carried_kg[1] + axes.carried_kg[2];
                            },
                            [&](const DeltaLengths& own) { return cranks(own.arm_m, 3); },
                            [](const PaddleLengths&) { return 0.0; },
                            [&](const PantographLengths& own) { return cranks(own.proximal_m, 2); },
                            [&](const ArmLengths& own) {
                              const Vec3 elbow_B = serial_arm_elbow(own, pose);
                              const double radius_squared =
                                  elbow_B.x() * elbow_B.x() + elbow_B.z() * elbow_B.z();
                              return radius_squared * pose.rows[0].squaredNorm() +
                                     own.upper_m * own.upper_m * pose.rows[1].squaredNorm();
                            }},
                 mechanism);
  return weights.handle_kg + weights.elbow_kg * trace / static_cast<double>(joints_of(mechanism));
}

double whole_length_m(const PlantMechanism& mechanism) {
  return std::visit(
      Overloaded{[](const CartesianAxes&) { return 1.0; },
                 [](const DeltaLengths& own) { return own.arm_m + own.rod_m + own.end_pieces_m; },
                 [](const PaddleLengths& own) { return own.radius_m; },
                 [](const PantographLengths& own) { return own.proximal_m + own.distal_m; },
                 [](const ArmLengths& own) { return own.upper_m + own.forearm_m; }},
      mechanism);
}

}  // namespace tactus::host
