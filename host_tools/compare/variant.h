// A scene with one thing changed: its contact method, friction model, push-out or rate. `tactus
// compare` makes one of each combination.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// The differences from the scene as it is written.
struct Variant {
  // The changes, for tables and keys: "three_step, 500 Hz".
  std::string name;
  std::optional<rendering::ContactMethod> method;
  std::optional<rendering::FrictionKind> friction;
  std::optional<double> push_out_m;
  std::optional<rendering::Sides> sides;
  // The ticks in a second; nothing for those of the path.
  std::optional<double> rate_Hz;
};

// The values to combine; an empty list leaves the scene's own.
struct VariantLists {
  std::vector<std::string> methods;
  std::vector<std::string> frictions;
  std::vector<double> push_outs_mm;
  std::vector<std::string> sides;
  std::vector<double> rates_Hz;
};

// Returns all combinations, in the order of the lists; one that changes nothing if all are empty.
// Throws InputError for an unknown name, a value that is there twice, a push-out below 0 and a rate
// that is not above 0.
std::vector<Variant> variants_of(const VariantLists& lists);

// Returns the scene with the variant's method, friction model and push-out on the object `name`, or
// on all objects if that is empty. Throws InputError if there is no such object, or if one of them
// cannot be touched in that manner.
SceneDescription changed(SceneDescription scene, const Variant& variant, const std::string& name);

}  // namespace tactus::host
