#include "firmware/configuration/mechanism_check.h"

namespace tactus::firmware {
namespace {

// The bounds of dimensions and weights of a desktop device. They exclude wrong units, such as
// millimetres or grams.
constexpr double kShortestLink_m = 0.001;
constexpr double kLongestLink_m = 1.0;
constexpr double kHeaviestLink_kg = 10.0;

// The names of a weight's two fields, for the error.
struct WeightFields {
  std::string_view mass;
  std::string_view centre;
};

void check_mass(RangeCheck& check, std::string_view field, double mass_kg) {
  check.in(field, mass_kg, 0.0, kHeaviestLink_kg);
}

void check_weight(RangeCheck& check, const WeightFields& fields, const LinkWeight& weight) {
  check_mass(check, fields.mass, weight.mass_kg);
  check.in(fields.centre, weight.centre_m, -kLongestLink_m, kLongestLink_m);
}

void check_link(RangeCheck& check, std::string_view field, double length_m) {
  check.in(field, length_m, kShortestLink_m, kLongestLink_m);
}

void check_geometry(RangeCheck& check, const CartesianGeometry& g) {
  for (const double mass_kg : g.carried_kg) {
    check_mass(check, "mechanism.carried_kg", mass_kg);
  }
}

void check_geometry(RangeCheck& check, const DeltaGeometry& g) {
  check_link(check, "mechanism.arm_m", g.arm_m);
  check_link(check, "mechanism.rod_m", g.rod_m);
  check.in("mechanism.hinge_offset_m", g.hinge_offset_m, 0.0, g.rod_m);
  check.in("mechanism.base_radius_m", g.base_radius_m, 0.0, 1.0);
  check.in("mechanism.base_tangent_m", g.base_tangent_m, -1.0, 1.0);
  check.in("mechanism.platform_radius_m", g.platform_radius_m, 0.0, 1.0);
  check.in("mechanism.platform_tangent_m", g.platform_tangent_m, -1.0, 1.0);
  for (const double azimuth : g.azimuth_rad) {
    check.in("mechanism.azimuth_rad", azimuth, -6.3, 6.3);
  }
  check.in("mechanism.nominal_height_m", g.nominal_height_m, 0.0, 2.0);
  check_weight(check, {"mechanism.arm.mass_kg", "mechanism.arm.centre_m"}, g.arm);
  check_mass(check, "mechanism.rods_kg", g.rods_kg);
  check_mass(check, "mechanism.platform_kg", g.platform_kg);
}

void check_geometry(RangeCheck& check, const PaddleGeometry& g) {
  check_link(check, "mechanism.handle_radius_m", g.handle_radius_m);
  check_weight(check, {"mechanism.paddle.mass_kg", "mechanism.paddle.centre_m"}, g.paddle);
}

void check_geometry(RangeCheck& check, const PantographGeometry& g) {
  check.in("mechanism.base_m", g.base_m, 0.0, kLongestLink_m);
  check_link(check, "mechanism.proximal_m", g.proximal_m);
  check_link(check, "mechanism.distal_m", g.distal_m);
  check_weight(check, {"mechanism.proximal.mass_kg", "mechanism.proximal.centre_m"}, g.proximal);
  check_weight(check, {"mechanism.distal.mass_kg", "mechanism.distal.centre_m"}, g.distal);
  check_mass(check, "mechanism.tool_kg", g.tool_kg);
}

void check_geometry(RangeCheck& check, const SerialArmGeometry& g) {
  check_link(check, "mechanism.upper_m", g.upper_m);
  check_link(check, "mechanism.forearm_m", g.forearm_m);
  check.in("mechanism.shoulder_height_m", g.shoulder_height_m, -2.0, 2.0);
  check_weight(check, {"mechanism.upper.mass_kg", "mechanism.upper.centre_m"}, g.upper);
  check_weight(check, {"mechanism.forearm.mass_kg", "mechanism.forearm.centre_m"}, g.forearm);
  check_mass(check, "mechanism.tool_kg", g.tool_kg);
}

}  // namespace

void check_mechanism(RangeCheck& check, const MechanismGeometry& mechanism) {
  if (const auto* cartesian = std::get_if<CartesianGeometry>(&mechanism)) {
    check_geometry(check, *cartesian);
  } else if (const auto* delta = std::get_if<DeltaGeometry>(&mechanism)) {
    check_geometry(check, *delta);
  } else if (const auto* paddle = std::get_if<PaddleGeometry>(&mechanism)) {
    check_geometry(check, *paddle);
  } else if (const auto* pantograph = std::get_if<PantographGeometry>(&mechanism)) {
    check_geometry(check, *pantograph);
  } else if (const auto* arm = std::get_if<SerialArmGeometry>(&mechanism)) {
    check_geometry(check, *arm);
  }
}

}  // namespace tactus::firmware
