#include "host_tools/touch/named_bodies.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns a name as a field of a CSV file.
std::string field(std::string_view name) {
  if (name.find_first_of(",\"\n") == std::string_view::npos) {
    return std::string(name);
  }
  std::string quoted = "\"";
  for (const char letter : name) {
    quoted += letter;
    if (letter == '"') {
      quoted += letter;
    }
  }
  return quoted + '"';
}

}  // namespace

std::vector<NamedBody> named_bodies(const rendering::SceneImage& scene, std::string_view option) {
  std::vector<NamedBody> bodies;
  for (std::uint32_t i = 0; i < scene.objects().size(); ++i) {
    const rendering::Object& object = scene.objects()[i];
    if (is_body(object)) {
      bodies.push_back({.name = field(scene.object_name(i)),
                        .object = i,
                        .axes_O = scene.bodies()[object.body].axes_O});
    }
  }
  if (bodies.empty()) {
    throw InputError(
        fmt::format("the scene has no bodies; give an object a [object.body] and bake the scene "
                    "again, or leave out {}",
                    option));
  }
  return bodies;
}

}  // namespace tactus::host
