// The file of `tactus touch --bodies`: where each body is at each tick.
#pragma once

#include <filesystem>
#include <vector>

#include "host_tools/simulation/run_log.h"
#include "host_tools/touch/named_bodies.h"
#include "rendering/scene/scene_image.h"
#include "rendering/world/world.h"

namespace tactus::host {

// One row for each tick and body, in the order of the objects: the centre of mass (m) and its
// velocity (m/s), the rotation of the object's axes as a unit quaternion with qw >= 0, and the
// angular velocity (rad/s); world frame.
class BodiesCsv {
 public:
  // Throws InputError if the file cannot be written, or if the scene has no bodies.
  BodiesCsv(const std::filesystem::path& path, const rendering::SceneImage& scene);

  // Appends the bodies as they are at `t_s`, before the tick of that time.
  void add(double t_s, const rendering::World& world);
  // Puts the complete file in its place.
  void close() { file_.close(); }

 private:
  LogFile file_;
  std::vector<NamedBody> bodies_;
};

}  // namespace tactus::host
